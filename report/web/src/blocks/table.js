// Tables: {caption, columns: [{label, unit, align}], rows: [[...]]}. Numbers are formatted; texts stand as they are.
import { h } from '../dom.js';
import { number, typeset } from '../format.js';

const isNumeric = (cell) => typeof cell === 'number' || /^[\s+\-\u2212*\u2013]*[\d.]+/.test(String(cell ?? ''));

function isNumberColumn(rows, i) {
  const filled = rows.map((row) => row[i]).filter((cell) => cell !== null && cell !== '' && cell !== '-');
  return filled.length > 0 && filled.filter(isNumeric).length > filled.length / 2;
}

function makeHead(columns, aligns) {
  return h('thead', null, h('tr', null, columns.map((column, i) =>
    h('th', { scope: 'col', class: aligns[i] }, column.label ?? column, column.unit && h('span', { class: 'unit' }, ` ${column.unit}`)))));
}

export function makeTable({ caption, columns, rows }) {
  const aligns = columns.map((column, i) => column.align || (isNumberColumn(rows, i) ? 'right' : 'left'));
  const body = rows.map((row) =>
    h('tr', null, row.map((cell, i) => {
      const text = typeof cell === 'number' ? number(cell) : typeset(cell ?? '\u2013');
      return i === 0 ? h('th', { scope: 'row', class: aligns[i] }, text) : h('td', { class: aligns[i] }, text);
    })));
  return h('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption || 'table' },
    h('table', null, caption && h('caption', null, caption), makeHead(columns, aligns), h('tbody', null, body)));
}

export const tableBlock = (block) => makeTable(block);

const kLong = 48; // characters of a value that is a sentence, and breaks

/// Label and value: {caption, lines: [{label, value}]}. A label that begins with two blanks is part of the line above.
export function linesBlock({ caption, lines }) {
  return h('table', { class: 'lines' }, caption && h('caption', null, caption),
    h('tbody', null, lines.map(({ label, value }) =>
      h('tr', null, h('th', { scope: 'row', class: label.startsWith('  ') ? 'sub' : '' }, label.trim()),
        h('td', { class: value.length > kLong ? 'long' : '' }, typeset(value))))));
}
