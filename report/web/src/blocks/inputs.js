// All inputs: an object of numbers, texts and further objects, as one table a group.
import { h } from '../dom.js';
import { plain } from '../format.js';

const isGroup = (value) => value !== null && typeof value === 'object' && !Array.isArray(value);

function show(value) {
  if (value === null) return 'not set';
  if (Array.isArray(value)) return value.length === 0 ? 'none' : value.map(show).join(', ');
  if (isGroup(value)) return JSON.stringify(value);
  return typeof value === 'number' ? String(value).replace('-', '\u2212') : String(value);
}

function makeGroup(name, group) {
  const plainEntries = Object.entries(group).filter(([, value]) => !isGroup(value));
  const groups = Object.entries(group).filter(([, value]) => isGroup(value));
  return [
    plainEntries.length > 0 && h('table', { class: 'lines inputs' }, h('caption', null, name),
      h('tbody', null, plainEntries.map(([key, value]) =>
        h('tr', null, h('th', { scope: 'row' }, h('code', null, key)), h('td', null, show(value)))))),
    ...groups.flatMap(([key, value]) => makeGroup(`${name} \u203a ${plain(key)}`, value)),
  ];
}

/// {groups: {name: {...}}}
export function inputsBlock({ groups }) {
  const tables = Object.entries(groups).flatMap(([name, value]) =>
    isGroup(value) ? makeGroup(plain(name), value) : makeGroup(plain(name), { [name]: value }));
  return h('div', { class: 'columns' }, tables);
}
