// Saves a chart, a table of shades or a drawing: its data as CSV, its picture as SVG or PNG. Nothing leaves the page but
// files that the reader asks for.
import { h, svg } from './dom.js';
import { color } from './theme.js';

const kPixelRatio = 2; // of a PNG: sharp on a dense screen and on paper

/// "drum_torque" of "Drum torque": what may stand in a column name and in a file name.
const slug = (text) => String(text).toLowerCase().replace(/[^\p{L}\p{N}]+/gu, '_').replace(/^_+|_+$/g, '');

/// Units as the program's own files have them: "degC" of "°C", "km_h" of "km/h", "N_per_kN" of "N/kN".
function unitSuffix(unit) {
  return String(unit || '').replace(/\u00b0C/g, 'degC').replace(/%/g, 'percent').replace(/\u00b2/g, '2').replace(/\u00b3/g, '3').replace(/\bN m\b/g, 'Nm')
    .replace(/\b(km\/h|m\/s|rad\/s)/g, (quotient) => quotient.replace('/', '_')).replace(/\//g, '_per_').replace(/[^\p{L}\p{N}]+/gu, '_').replace(/^1_per_/, 'per_').replace(/^_+|_+$/g, '');
}

/// "speed_km_h": the quantity and its unit.
export const columnName = (quantity, unit) => [slug(quantity) || 'value', unitSuffix(unit)].filter(Boolean).join('_');

/// A column of a CSV file: {name, values}. With columnOf(), of a heading such as "drum torque, N m".
export const column = (quantity, unit, values) => ({ name: columnName(quantity, unit), values });

export function columnOf(heading, values) {
  const at = heading.lastIndexOf(', ');
  return at < 0 ? column(heading, '', values) : column(heading.slice(0, at), heading.slice(at + 2), values);
}

/// The number that a text shows, else the text.
export function numberOrText(text) {
  const number = Number(String(text).trim().replace('\u2212', '-'));
  return String(text).trim() === '' || Number.isNaN(number) ? text : number;
}

function showCell(value) {
  if (value === null || value === undefined) return '';
  const text = String(value); // of a number all digits that it has
  return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function makeCsv(columns) {
  const names = columns.map(({ name }, i) => {
    const before = columns.slice(0, i).filter((one) => one.name === name).length;
    return before > 0 ? `${name}_${before + 1}` : name;
  });
  const count = Math.max(0, ...columns.map(({ values }) => values.length));
  const rows = Array.from({ length: count }, (_, i) => columns.map(({ values }) => showCell(values[i])).join(','));
  return [names.map(showCell).join(','), ...rows, ''].join('\n');
}

/// Characters that XML cannot hold; names of folders may.
const kNotInXml = /[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]|\p{Surrogate}/gu;

/// The picture as it is drawn now, on the color of the page.
function makeSvg({ title, picture }) {
  const { svg: drawn, width, height } = picture();
  const root = drawn.cloneNode(true);
  root.removeAttribute('style');
  const [x, y] = (root.getAttribute('viewBox') || '0 0').split(' ');
  root.prepend(svg('title', null, title), svg('rect', { x, y, width: '100%', height: '100%', fill: color('paper') }));
  return { text: new XMLSerializer().serializeToString(root).replace(kNotInXml, ''), width, height };
}

async function makePng({ text, width, height }) {
  const url = URL.createObjectURL(new Blob([text], { type: 'image/svg+xml' }));
  try {
    const image = new Image(width, height);
    image.src = url;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = kPixelRatio * width;
    canvas.height = kPixelRatio * height;
    canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done) => canvas.toBlob(done, 'image/png'));
  } finally {
    URL.revokeObjectURL(url);
  }
}

function download(blob, name) {
  const url = URL.createObjectURL(blob);
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60000); // the browser may still read it
}

const kWays = [
  { label: 'Data as CSV', ending: 'csv', make: async (saved) => new Blob([makeCsv(saved.data())], { type: 'text/csv' }) },
  { label: 'Picture as SVG', ending: 'svg', make: async (saved) => new Blob([makeSvg(saved).text], { type: 'image/svg+xml' }) },
  { label: 'Picture as PNG', ending: 'png', make: async (saved) => makePng(makeSvg(saved)) },
];

document.addEventListener('pointerdown', (event) => document.querySelectorAll('details.save[open]').forEach((menu) => menu.contains(event.target) || (menu.open = false)));

/// The menu of what can be saved: {title, data(): columns of its CSV, picture(): {svg, width, height}}. It closes when it has
/// done its work, by Escape, and when something else is chosen.
export function saveMenu(saved) {
  const buttons = kWays.map(({ label, ending, make }) => h('button', { type: 'button', onclick: async () => {
    menu.open = false;
    menu.firstChild.focus();
    download(await make(saved), `${slug(saved.title) || 'chart'}.${ending}`);
  } }, label));
  const menu = h('details', { class: 'save' }, h('summary', { 'aria-label': `Save: ${saved.title}` }, 'Save'), h('div', null, buttons));
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !menu.open) return;
    menu.open = false;
    menu.firstChild.focus();
  });
  menu.addEventListener('focusout', (event) => event.relatedTarget && !menu.contains(event.relatedTarget) && (menu.open = false));
  return menu;
}
