// Page breaks in print. What may not be cut goes to the next sheet as a whole: a high chart would leave half a sheet
// empty, and is made lower by as much as it lacks. A last sheet with a few lines is taken onto the one before likewise;
// where that cannot be, more goes to the last sheet.
import { chartsIn } from './chart.js';

const kSheet_px = (297 - 2 * 16) / 25.4 * 96; // A4 without the margins of style.css
const kLeastFilled = 0.55; // of a sheet, below which it is worth making the next chart lower
const kMostLess = 0.45; // of a chart's height
const kLeast_px = 120; // of a chart's height
const kLastLines = 0.15; // of a sheet
const kUnsure = 0.07; // of a sheet, by which the browser may fill the last one more than is reckoned here

let startsSheet = null; // what begins the last sheet, though there was room for it on the one before

/// What is not cut, in order: a heading and what follows it are one.
function listWholes() {
  const wholes = [];
  let head = null; // a heading
  for (const one of document.querySelectorAll('header, main h2, main h3, main figure:not(.timesfigure):not(:has(.map)), main figure:has(.map) > figcaption, main .times.part, main .lead, main .tiles, main tr, main p, main li, main .equation')) {
    if (one.offsetParent === null || one.parentElement.closest('figure:not(.timesfigure):not(:has(.map)), .lead, .tiles')) continue;
    const { top, bottom } = one.getBoundingClientRect();
    if (!(bottom > top)) continue;
    if (/^H[23]$/.test(one.tagName)) {
      head = head ?? { one, top };
      continue;
    }
    const [chart] = one.matches('figure') ? chartsIn(one) : [];
    const heading_px = one.matches('tbody tr') ? (one.closest('table').tHead?.offsetHeight ?? 0) : 0; // stands again on a new sheet
    wholes.push({ first: head?.one ?? one, top: head?.top ?? top, bottom, chart, table: one.closest('table'), heading_px });
    head = null;
  }
  return wholes;
}

/// The first whole before which a sheet ends too early, with the height that it lacks; how far the last sheet is filled.
function layOut(wholes) {
  const start = wholes[0].top;
  let pushed = 0;
  let tooEarly = null;
  let end = 0;
  for (const [i, whole] of wholes.entries()) {
    const [top, bottom] = [whole.top - start + pushed, whole.bottom - start + pushed];
    const sheetEnd = (Math.floor(top / kSheet_px + 1e-6) + 1) * kSheet_px;
    end = bottom;
    if (bottom <= sheetEnd || bottom - top > kSheet_px) continue;
    const filled = 1 - (sheetEnd - top) / kSheet_px;
    if (!tooEarly && filled < kLeastFilled) tooEarly = { whole, lacking: bottom - sheetEnd };
    const isGoingOn = whole.table && whole.table === wholes[i - 1]?.table;
    const added = sheetEnd - top + (isGoingOn ? whole.heading_px : 0);
    pushed += added;
    end += added;
  }
  return { tooEarly, last: (end / kSheet_px) % 1, sheets: Math.ceil(end / kSheet_px - 1e-6) };
}

/// Makes a chart lower by so much, where it stays readable. Returns whether it did.
function lower(chart, by_px) {
  const height = chart.element.offsetHeight;
  if (by_px > kMostLess * height || height - by_px < kLeast_px) return false;
  chart.less_px += by_px;
  chart.redraw();
  return true;
}

/// Moves so much to the last sheet that it has more than a few lines: from a heading on, where there is one.
function moveToLastSheet(wholes) {
  const end = wholes[wholes.length - 1].bottom;
  const movable = wholes.filter(({ top }) => end - top >= kLastLines * kSheet_px && end - top <= kLeastFilled * kSheet_px).reverse();
  const begins = movable.find(({ first }) => /^H[23]$/.test(first.tagName)) ?? movable[0];
  if (!begins) return;
  startsSheet = begins.first;
  startsSheet.style.breakBefore = 'page';
}

export function fillSheets() {
  if (listWholes().length === 0) return;
  const tried = new Set();
  for (let passes = 0; passes < 40; ++passes) {
    const { tooEarly } = layOut(listWholes());
    if (!tooEarly || tried.has(tooEarly.whole.chart)) break;
    tried.add(tooEarly.whole.chart);
    if (tooEarly.whole.chart) lower(tooEarly.whole.chart, tooEarly.lacking + 6);
  }
  const { last, sheets } = layOut(listWholes());
  const hasFewLines = sheets > 1 && last > 0 && last <= kLastLines;
  if (!hasFewLines && last < 1 - kUnsure) return;
  const charts = listWholes().map(({ chart }) => chart).filter(Boolean).reverse();
  const before_px = charts.map((chart) => chart.less_px);
  let needed = ((hasFewLines ? last : kUnsure) + kUnsure) * kSheet_px;
  for (const chart of charts) {
    const by_px = Math.min(needed, 0.4 * chart.element.offsetHeight);
    if (lower(chart, by_px)) needed -= by_px;
    if (needed <= 0) return;
  }
  charts.forEach((chart, i) => {
    chart.less_px = before_px[i];
    chart.redraw();
  });
  moveToLastSheet(listWholes());
}

/// Every chart in its own height again, and no break of ours.
export function restoreSheets() {
  startsSheet?.style.removeProperty('break-before');
  startsSheet = null;
  chartsIn(document.body).forEach((chart) => (chart.less_px = 0));
}
