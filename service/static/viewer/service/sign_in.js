// Signing in, if the service needs a key: the page asks once, and exchanges the key for a cookie that no script can read.

import { make } from '../dom.js';

const SIGNED_IN = 'caesura-signed-in'; // stored in this browser, to offer signing out; never the key

/** Resolves once a person has signed in. Several calls make one dialog. */
export function waitForSignIn() {
  pending ??= askForKey().finally(() => { pending = null; });
  return pending;
}
let pending = null;

function askForKey() {
  const key = make('input', { type: 'password', id: 'key', autocomplete: 'current-password', required: true });
  const problem = make('p', { className: 'problem', role: 'alert', hidden: true });
  const form = make('form', { method: 'dialog' },
    make('h2', { id: 'sign-in' }, 'This service needs a key'),
    make('p', { className: 'faint' }, 'Ask the person who runs the service for one.'),
    make('p', { className: 'ask' }, make('label', { htmlFor: 'key' }, 'Key'), key, make('button', { type: 'submit', className: 'primary' }, 'Sign in')),
    problem);
  const dialog = make('dialog', { 'aria-labelledby': 'sign-in' }, form);
  dialog.addEventListener('cancel', (event) => event.preventDefault()); // without a key nothing on the page works
  document.body.append(dialog);
  dialog.showModal();
  return new Promise((resolve) => {
    form.addEventListener('submit', async (event) => {
      event.preventDefault();
      const refused = await refusalOf(key.value);
      problem.textContent = refused;
      problem.hidden = !refused;
      if (refused) { key.select(); return; }
      localStorage.setItem(SIGNED_IN, 'yes');
      dialog.close();
      dialog.remove();
      offerSignOut();
      resolve();
    });
  });
}

/** Why the service refused the key; empty if it did not. */
async function refusalOf(key) {
  const answer = await fetch('/v1/session', {
    method: 'POST', body: JSON.stringify({ key }), headers: { 'Content-Type': 'application/json' },
  }).catch(() => null);
  if (answer?.ok) return '';
  const document = await answer?.json().catch(() => null);
  return document?.detail || 'The service does not answer.';
}

function offerSignOut() {
  if (!localStorage.getItem(SIGNED_IN) || document.getElementById('sign-out')) return;
  document.querySelector('header').append(make('button', { type: 'button', id: 'sign-out', onclick: signOut }, 'Sign out'));
}

async function signOut() {
  await fetch('/v1/session', { method: 'DELETE' }).catch(() => null);
  localStorage.removeItem(SIGNED_IN);
  location.assign('/');
}

offerSignOut();
