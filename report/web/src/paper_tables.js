// Tables on paper. What is wider than the page is made smaller. What would then be too small to read is split into
// tables one below the other, each with the columns that tell the rows apart.

const kLeast = 0.7; // of the size on the screen
const kMostKeys = 3;

const roomOf = (table) => table.parentElement.clientWidth / table.scrollWidth;
const rowsOf = (table) => [...table.rows].map((row) => [...row.cells]);

/// Whether every row has a cell for every column.
const isPlain = (rows) => rows.length > 1 && rows.every((cells) => cells.length === rows[0].length && cells.every((cell) => cell.colSpan === 1 && cell.rowSpan === 1));

/// How many of the first columns tell the rows apart; one where a few do not.
function countKeys(rows) {
  for (let keys = 1; keys <= kMostKeys; ++keys) {
    const texts = rows.slice(1).map((cells) => cells.slice(0, keys).map((cell) => cell.textContent).join('|'));
    if (new Set(texts).size === texts.length) return keys;
  }
  return 1;
}

/// Columns of each part, as many as fit.
function divide(widths, keys, room) {
  const ofKeys = widths.slice(0, keys).reduce((sum, width) => sum + width, 0);
  const parts = [];
  let used = Infinity;
  for (let column = keys; column < widths.length; ++column) {
    if (used + widths[column] > room) {
      parts.push([]);
      used = ofKeys;
    }
    parts.at(-1).push(column);
    used += widths[column];
  }
  return parts;
}

function split(table) {
  const rows = rowsOf(table);
  if (!isPlain(rows)) return;
  const keys = countKeys(rows);
  const parts = divide(rows[0].map((cell) => cell.offsetWidth), keys, table.parentElement.clientWidth / kLeast);
  parts.forEach((columns) => {
    const part = table.cloneNode(true);
    part.classList.add('part');
    rowsOf(part).forEach((cells) => cells.forEach((cell, i) => i >= keys && !columns.includes(i) && cell.remove()));
    table.before(part);
  });
  table.hidden = true;
}

export function fitTables() {
  const tables = () => [...document.querySelectorAll('.scroll > table:not([hidden])')];
  tables().filter((table) => roomOf(table) < kLeast).forEach(split);
  tables().forEach((table) => {
    const room = roomOf(table);
    if (room > 0 && room < 1) table.style.zoom = 0.98 * room;
  });
}

export function restoreTables() {
  document.querySelectorAll('.scroll > table.part').forEach((part) => part.remove());
  document.querySelectorAll('.scroll > table').forEach((table) => {
    table.hidden = false;
    table.style.zoom = '';
  });
}
