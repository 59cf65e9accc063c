// The settings under Advanced: a field for each parameter of the method, with what it is for, from the service's list.

import { $, make } from '../dom.js';

const ELSEWHERE = new Set(['method', 'motions', 'take']); // have their own place on the page

let listed = new Map(); // the properties of each method's parameters

/** Take over the service's list of methods. */
export function offerSettings(methods) {
  listed = new Map(methods.map(({ name, description, parameters }) => [name, { description, properties: parameters.properties }]));
}

/** Wire the button once. `apply(changes)` is called with what a person has set otherwise than `parameters()`. */
export function addAdvancedSettings(parameters, apply) {
  $('apply-settings').addEventListener('click', () => {
    const before = parameters();
    const changes = [...$('settings').querySelectorAll('[name]')].map((field) => [field.name, valueOf(field)])
      .filter(([name, value]) => String(value) !== String(before[name]));
    if (changes.length) apply(Object.fromEntries(changes));
  });
}

/** Show the settings that a result was made with. */
export function showSettings({ method, parameters }) {
  const { description = '', properties = {} } = listed.get(method) ?? {};
  $('method-purpose').textContent = description;
  const names = Object.keys(properties).filter((name) => !ELSEWHERE.has(name));
  const weight = (kind) => names.filter((name) => properties[name].weight === kind);
  const group = (title, kind) => [make('h3', {}, title), ...weight(kind).map((name) => setting(name, properties[name], parameters[name]))];
  $('settings').replaceChildren(...group('At once', 'light'), ...group('The take is measured again', 'heavy'));
}

function setting(name, schema, value) {
  const id = `setting-${name}`;
  const label = name.replaceAll('_', ' ').replace(/ seconds$/, ', seconds');
  const described = { id, name, 'aria-describedby': `${id}-purpose` };
  return make('div', { className: 'setting' }, make('label', { htmlFor: id }, label), field(schema, value, described),
    make('p', { className: 'hint', id: `${id}-purpose` }, schema.description.replaceAll('`', '')));
}

function field(schema, value, described) {
  if (schema.type === 'boolean') return make('input', { ...described, type: 'checkbox', checked: value });
  if (!schema.enum) return make('input', { ...described, value, autocomplete: 'off', inputMode: 'text' });
  const menu = make('select', described, ...schema.enum.map((choice) => make('option', { value: choice }, choice)));
  menu.value = value;
  return menu;
}

function valueOf(field) {
  if (field.type === 'checkbox') return field.checked;
  const text = field.value.trim();
  return text !== '' && Number.isFinite(Number(text)) ? Number(text) : text;
}
