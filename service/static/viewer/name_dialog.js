// A dialog that asks for a name.

import { make } from './dom.js';

/** Resolves with what a person writes, without blanks around it; null where they give up. */
export function askForName({ title, label = 'Name', value = '', action = 'Rename' }) {
  const field = make('input', { id: 'new-name', value, maxLength: 100, required: true, autocomplete: 'off' });
  const dialog = make('dialog', { 'aria-labelledby': 'rename-title' }, make('form', { method: 'dialog' },
    make('h2', { id: 'rename-title' }, title),
    make('p', { className: 'ask' }, make('label', { htmlFor: 'new-name' }, label), field,
      make('button', { value: 'save', className: 'primary' }, action), make('button', { value: '', formNoValidate: true }, 'Cancel'))));
  document.body.append(dialog);
  dialog.showModal();
  field.select();
  return new Promise((answer) => {
    dialog.addEventListener('close', () => {
      dialog.remove();
      answer(dialog.returnValue === 'save' ? field.value.trim() || null : null);
    });
  });
}
