// What the page says in one look: {tiles: [{label, value, unit, note, tone: good | doubt | bad}]}. The value is a text.
import { h } from '../dom.js';
import { typeset } from '../format.js';

const kSigns = { good: '\u2713', doubt: '?', bad: '!' };

/// A value stays on one line with its interval: "7.12 \u00b1 0.05".
const joined = (text) => typeset(text).replace(/ \u00b1 /g, '\u00a0\u00b1\u00a0');

function makeTile({ label, value, unit, note, tone }) {
  return h('div', { class: `tile ${tone || ''}` },
    h('dt', null, kSigns[tone] && h('span', { class: 'sign', 'aria-hidden': 'true' }, kSigns[tone]), label),
    h('dd', { class: 'value' }, joined(value), unit && h('span', { class: 'unit' }, `\u00a0${unit}`)),
    note && h('dd', { class: 'note' }, typeset(note)));
}

export const tilesBlock = ({ tiles }) => h('dl', { class: 'tiles' }, tiles.map(makeTile));
