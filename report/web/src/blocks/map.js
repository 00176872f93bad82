// A map of deviations: rows of places, columns of channels, each cell with its number and a shade from
// -4 (cool) to 4 (warm); a cell that counts has an outline and what makes it count.
// {caption, heads: [group, label], columns: [...], rows: [{group, label, cells: [{text, shade, marked, note}]}], legend}
import { h } from '../dom.js';
import { typeset } from '../format.js';
import { drawTable } from '../picture.js';
import { column, columnOf, numberOrText, saveMenu } from '../save.js';

/// What is saved has the first sentence of the caption as its name.
const makeFoot = (caption, table, data) => h('div', { class: 'chartfoot' }, saveMenu({ title: caption.split('. ')[0], data, picture: () => drawTable(table) }));

function makeCell(cell) {
  if (!cell) return h('td', { class: 'empty' }, '\u00b7');
  const side = cell.shade > 0 ? 'above' : 'below';
  return h('td', { class: `z${Math.abs(cell.shade)} ${side}${cell.marked ? ' marked' : ''}`, title: cell.note },
    typeset(cell.text), cell.marked && h('span', { class: 'z' }, typeset(cell.marked)));
}

/// A row for each row of the map. What a cell is marked with has a column of its own.
function makeMapData({ heads = ['run', 'phase'], columns, rows }) {
  const cells = (of) => columns.map((_, i) => rows.map(({ cells: row }) => row[i] && of(row[i])));
  const numbers = cells(({ text }) => numberOrText(text));
  const marks = cells(({ marked }) => marked || null);
  const hasGroups = rows.some(({ group }) => group);
  return [...(hasGroups ? [columnOf(heads[0] || 'group', rows.map(({ group }) => group))] : []), columnOf(heads[1] || 'row', rows.map(({ label }) => numberOrText(label))),
    ...columns.flatMap((name, i) => [columnOf(name, numbers[i]), ...(marks[i].some(Boolean) ? [column(`${name} mark`, '', marks[i])] : [])])];
}

export function mapBlock(block) {
  const { caption, heads = ['run', 'phase'], columns, rows, legend } = block;
  const groups = [];
  for (const row of rows) {
    if (!groups.length || groups.at(-1).name !== row.group) groups.push({ name: row.group, rows: [] });
    groups.at(-1).rows.push(row);
  }
  const bodies = groups.map((group) => h('tbody', null, group.rows.map((row, i) => h('tr', null,
    i === 0 && h('th', { scope: 'rowgroup', rowspan: group.rows.length, class: 'group' }, group.name),
    h('th', { scope: 'row' }, row.label), row.cells.map(makeCell)))));
  const table = h('table', { class: 'map' }, h('caption', null, caption),
    h('thead', null, h('tr', null, heads.map((head) => h('th', { scope: 'col' }, head)), columns.map((c) => h('th', { scope: 'col' }, c)))), bodies);
  return h('figure', null, h('div', { class: 'scroll', tabindex: '0', role: 'region', 'aria-label': caption }, table),
    legend && h('figcaption', null, legend), makeFoot(caption, table, () => makeMapData(block)));
}

/// Shares as bars in a table: {caption, columns: [label, value], rows: [{label, note, share, text}]}
export function sharesBlock({ caption, columns, rows }) {
  const data = () => [column(columns[0], '', rows.map(({ label }) => label)), column(columns[1], '', rows.map(({ share }) => share))];
  const table = h('table', { class: 'shares' }, h('caption', null, caption),
    h('thead', null, h('tr', null, columns.map((c, i) => h('th', { scope: 'col', class: i === 1 ? 'right' : '' }, c)), h('th', { 'aria-hidden': 'true' }))),
    h('tbody', null, rows.map((row) => h('tr', null,
      h('th', { scope: 'row' }, row.label, row.note && h('span', { class: 'note' }, row.note)),
      h('td', { class: 'right' }, row.text),
      h('td', { class: 'bar', 'aria-hidden': 'true' }, h('div', null, h('span', { style: `width:${row.share > 0 ? Math.max(0.5, 100 * Math.min(1, row.share)).toFixed(2) : 0}%` })))))));
  return h('figure', null, h('div', { class: 'scroll' }, table), makeFoot(caption, table, data));
}
