// Which column of a log is which: guessed by the program, confirmed or corrected by the person.
import { h } from '../dom.js';
import { number } from '../format.js';
import { makeNumberField } from './number_field.js';

const kNone = '\u0000none';
const kConstant = '\u0000constant';

/// A row of the table: a column of the set and where it comes from.
function makeRow(target, { guessed, headings, said, onChange }) {
  const isConstant = guessed?.value !== undefined && guessed?.value !== null;
  const shown = isConstant ? kConstant : guessed?.heading ?? said.columns[target.name] ?? kNone;
  const select = h('select', { 'aria-label': `column for ${target.name}`, 'data-target': target.name, onchange: () => {
    delete said.columns[target.name];
    delete said.values[target.name];
    if (select.value === kConstant) {
      constant.hidden = false; // asked for when it has a number
      constant.focus();
      return;
    }
    if (select.value !== kNone) said.columns[target.name] = select.value;
    onChange();
  } },
  h('option', { value: kNone, selected: shown === kNone }, guessed ? 'as guessed' : '\u2013'),
  headings.map((heading) => h('option', { value: heading.name, selected: shown === heading.name }, heading.name)),
  h('option', { value: kConstant, selected: shown === kConstant }, 'a constant'));
  const { field: constant, message } = makeNumberField({ value: isConstant ? guessed.value : '', hidden: shown !== kConstant, 'aria-label': `constant for ${target.name}`, onNumber: (value) => {
    delete said.columns[target.name];
    said.values[target.name] = value;
    onChange();
  } });
  const unit = h('input', { type: 'text', class: 'unitfield', value: guessed?.unit ?? said.units[target.name] ?? '', hidden: shown === kConstant || shown === kNone, 'aria-label': `unit of ${target.name} in the log`, onchange: () => {
    if (unit.value) said.units[target.name] = unit.value;
    else delete said.units[target.name];
    onChange();
  } });
  const example = headings.find((heading) => heading.name === shown)?.examples.join('; ');
  return h('tr', { class: !guessed && target.is_needed ? 'open' : '' }, h('th', { scope: 'row', title: target.doc }, target.name, target.is_needed && h('span', { class: 'unit' }, ' needed')),
    h('td', null, select, ' ', constant, message), h('td', null, unit), h('td', { class: 'examples' }, example || ''), h('td', { class: 'unit' }, guessed ? `${guessed.is_negative ? 'sign turned; ' : ''}${guessed.reason}` : ''));
}

/// Where the time comes from.
function makeTimeRow(time, headings, said, onChange) {
  const select = h('select', { 'aria-label': 'column for time', 'data-target': 'time', onchange: () => {
    said.columns.time = select.value;
    onChange();
  } }, !time && h('option', { value: '' }, '\u2013'), headings.map((heading) => h('option', { value: heading.name, selected: heading.name === (time?.heading ?? said.columns.time) }, heading.name)));
  const example = headings.find((heading) => heading.name === time?.heading)?.examples.join('; ');
  return h('tr', null, h('th', { scope: 'row' }, 'time'), h('td', null, select), h('td'), h('td', { class: 'examples' }, example || ''), h('td', { class: 'unit' }, time?.reason || ''));
}

/// The table of columns; `said` is what the person has said, and is changed in place before `onChange`.
export function makeColumns({ headings = [], targets = [], columns = [], time }, said, onChange) {
  if (!headings.length || !targets.length) return null;
  return h('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': 'columns' }, h('table', { class: 'columnstable' },
    h('thead', null, h('tr', null, ['column of the set', 'column of the logs', 'its unit', 'first cells', 'why'].map((text) => h('th', { scope: 'col' }, text)))),
    h('tbody', null, makeTimeRow(time, headings, said, onChange),
      targets.map((target) => makeRow(target, { guessed: columns.find((one) => one.target === target.name), headings, said, onChange })))));
}

/// What else was guessed: form, runs, sensors.
export function makeGuesses(guesses = [], targets = []) {
  const rest = guesses.filter((guess) => !targets.some((target) => target.name === guess.subject) && guess.subject !== 'time');
  return rest.length > 0 && h('table', { class: 'guesses' }, h('caption', null, 'Also guessed'), h('tbody', null, rest.map((guess) =>
    h('tr', null, h('th', { scope: 'row' }, guess.subject), h('td', null, guess.taken), h('td', { class: 'unit' }, guess.reason)))));
}

export const bytesText = (bytes) => (bytes >= 1048576 ? `${number(bytes / 1048576, 3)} MiB` : `${number(bytes / 1024, 3)} KiB`);
