// What the page says in one look: {tiles: [{label, value, unit, note, tone: good | doubt | bad}]}. The value is a text.
import { h } from '../dom.js';
import { typeset } from '../format.js';

const kSigns = { good: '\u2713', doubt: '?', bad: '!' };

/// Whether a value is a number: it is smaller where it is long, and breaks before its \u00b1 only.
const isNumber = (text) => /^[+\-\u2212]?\d/.test(text);
const kLong = 13; // characters that a tile has room for in its size
const sizeOf = (text) => (!isNumber(text) ? '' : text.length > kLong + 4 ? 'number longer' : text.length > kLong ? 'number long' : 'number');

function makeTile({ label, value, unit, note, tone }) {
  return h('div', { class: `tile ${tone || ''}` },
    h('dt', null, kSigns[tone] && h('span', { class: 'sign', 'aria-hidden': 'true' }, kSigns[tone]), label),
    h('dd', { class: 'value' }, h('span', { class: sizeOf(typeset(value)) }, typeset(value).replaceAll('\u00b1 ', '\u00b1\u00a0')), unit && ' ', unit && h('span', { class: 'unit' }, unit)),
    note && h('dd', { class: 'note' }, typeset(note)));
}

export const tilesBlock = ({ tiles }) => h('dl', { class: 'tiles' }, tiles.map(makeTile));
