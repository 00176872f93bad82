// From one value to another, step by step: {label, unit, start: {name, value}, steps: [{name, value, low, high}],
// end: {name, value}, caption}. A step's value is a signed difference; low and high are limits of it.
import { axisStyle, axisTitle, baseOption, Chart, figure, tipLine } from '../chart.js';
import { h } from '../dom.js';
import { decimalsFor, decimalsThatAddUp, fixed, number } from '../format.js';
import { column } from '../save.js';
import { color } from '../theme.js';
import { makeTable } from './table.js';

const kRow_px = { wide: 38, narrow: 52 };
const kNarrow_px = 600; // below, names stand above their bars instead of left of them
const kTitle_px = 26;
const kTick_px = 80; // from one number of the axis to the next, at least about so
const kFromZero = 0.2; // least part of the axis that the steps cover before it leaves zero out

/// A step of 1, 2 or 5 times a power of ten, with which a range has at most so many steps.
function roundStep(range, most) {
  const power = 10 ** Math.floor(Math.log10(range / most));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => range / step <= most * 1.0001);
}

const isNumber = (value) => value !== null && value !== undefined;
const signed = (value) => `${value > 0 ? '+' : ''}${number(value)}`;

/// A bar's number, with as many decimals as the largest has for four digits; with fewer where the numbers as they are
/// shown would not add up; with more where nothing would be left of it.
function showValues({ start, steps, end }) {
  const most = decimalsFor(0, Math.max(...[start, ...steps, end].map(({ value }) => Math.abs(value))));
  const decimals = decimalsThatAddUp([start, ...steps].map(({ value }) => value), end.value, most);
  return (value) => (Math.abs(value) < 0.5 * 10 ** -decimals ? number(value, 2) : fixed(value, decimals));
}

/// Rows from the top: where a bar begins and ends, and how its limits lie.
function makeRows(block) {
  const { start, steps, end } = block;
  const show = showValues(block);
  const rows = [{ name: start.name, from: 0, to: start.value, isTotal: true, text: show(start.value) }];
  let at = start.value;
  for (const step of steps) {
    const to = at + step.value;
    const limits = isNumber(step.low) && isNumber(step.high) ? [at + step.low, at + step.high] : null;
    rows.push({ name: step.name, from: at, to, limits, text: `${step.value > 0 ? '+' : ''}${show(step.value)}`, step });
    at = to;
  }
  rows.push({ name: end.name, from: 0, to: end.value, isTotal: true, text: show(end.value) });
  return rows;
}

/// The axis begins at zero, unless the steps would be too small to see.
function findRange(rows) {
  const ends = rows.flatMap((row) => [row.to, ...(row.limits || [])]);
  const far = Math.max(...ends.map(Math.abs));
  const [low, high] = [Math.min(...ends), Math.max(...ends)].map((end) => (Math.abs(end) < 1e-9 * far ? 0 : end)); // rounding
  if (low * high > 0 && high - low < kFromZero * far) {
    const margin = 0.5 * (high - low) || 0.1 * far;
    return { low: low - margin, high: high + margin, isCut: true };
  }
  const margin = 0.02 * (Math.max(high, 0) - Math.min(low, 0)) || 1;
  return { low: Math.min(0, low < 0 ? low - margin : 0), high: Math.max(0, high > 0 ? high + margin : 0), isCut: false };
}

const barStyle = (row) => {
  if (row.isTotal) return { fill: color('series-6') };
  return { fill: color(row.to > row.from ? 'series-2' : 'series-1') };
};

const text = (x, y, words, style) => ({ type: 'text', x, y, style: { text: words, fill: color('ink'), fontSize: 12, verticalAlign: 'middle', ...style } });
const line = (x1, y1, x2, y2, style) => ({ type: 'line', shape: { x1, y1, x2, y2 }, style });

/// One row: its bar, its limits, the step to the next row, its number and its name.
function drawRow(rows, range, { width, names, isNarrow }) {
  return (params, api) => {
    const i = params.dataIndex;
    const row = rows[i];
    const x_of = (value) => api.coord([value, i])[0];
    const y = api.coord([0, i])[1];
    const pitch = api.size([0, 1])[1];
    const middle = isNarrow ? y + 0.2 * pitch : y;
    const half = isNarrow ? 0.2 * pitch : 0.29 * pitch;
    const edge = range.low > 0 ? range.low : range.high;
    const from = x_of(row.isTotal ? (range.isCut ? edge : 0) : row.from);
    const to = x_of(row.to);
    const children = [
      { type: 'rect', shape: { x: Math.min(from, to), y: middle - half, width: Math.max(1, Math.abs(to - from)), height: 2 * half }, style: barStyle(row) },
    ];
    if (row.isTotal && range.isCut) {
      for (const dx of [6, 10]) children.push(line(from + dx - 3, middle + half, from + dx + 3, middle - half, { stroke: color('paper'), lineWidth: 2 }));
    }
    if (i + 1 < rows.length) children.push(line(to, middle - half, to, middle + pitch + half, { stroke: color('axis'), lineWidth: 1, lineDash: [3, 3] }));
    let right = Math.max(from, to);
    if (row.limits) {
      const [low, high] = row.limits.map(x_of);
      for (const [stroke, lineWidth] of [[color('paper'), 4], [color('ink'), 1.5]]) {
        children.push(line(low, middle, high, middle, { stroke, lineWidth }));
        for (const end of [low, high]) children.push(line(end, middle - 4, end, middle + 4, { stroke, lineWidth }));
      }
      right = Math.max(right, high);
    }
    children.push(text(right + 6, middle, row.text, { fontWeight: row.isTotal ? 650 : 400, stroke: color('paper'), lineWidth: 3 }));
    children.push(isNarrow
      ? text(0, y - 0.26 * pitch, row.name, { fontWeight: row.isTotal ? 650 : 400, width: width - 4, overflow: 'truncate', stroke: color('paper'), lineWidth: 3 })
      : text(names, y, row.name, { align: 'right', fontWeight: row.isTotal ? 650 : 400, width: names, overflow: 'break', lineHeight: 14 }));
    return { type: 'group', children };
  };
}

function makeOption(block, rows, width) {
  const axis = axisStyle();
  const isNarrow = width < kNarrow_px;
  const names = isNarrow ? 0 : Math.min(300, 0.36 * width);
  const range = findRange(rows);
  const unit = block.unit ? ` ${block.unit}` : '';
  return {
    ...baseOption(),
    tooltip: { ...baseOption().tooltip, trigger: 'item', formatter: ({ dataIndex }) => {
      const row = rows[dataIndex];
      const limits = row.limits ? [tipLine('from:', signed(row.step.low) + unit), tipLine('to:', signed(row.step.high) + unit)] : [];
      return [h('div', null, row.name), tipLine(row.isTotal ? 'value:' : 'change:', row.text + unit), ...limits, ...(row.isTotal ? [] : [tipLine('then at:', number(row.to) + unit)])];
    } },
    title: axisTitle([block.label, block.unit].filter(Boolean).join(', '), false),
    grid: { left: isNarrow ? 2 : names + 12, right: 70, top: kTitle_px, bottom: range.isCut ? 40 : 22 },
    xAxis: { ...axis, type: 'value', min: range.low, max: range.high, interval: roundStep(range.high - range.low, Math.max(2, Math.floor((width - names - 70) / kTick_px))), name: range.isCut ? 'the axis does not begin at zero' : '', nameLocation: 'middle', nameGap: 26,
      axisLabel: { ...axis.axisLabel, showMinLabel: !range.isCut && range.low === 0, showMaxLabel: !range.isCut && range.high === 0, formatter: (v) => number(v, 3) } },
    yAxis: { type: 'category', data: rows.map((row) => row.name), inverse: true, axisLabel: { show: false }, axisTick: { show: false }, axisLine: { show: false } },
    series: [{ type: 'custom', clip: false, data: rows.map((row, i) => [row.to, i]), encode: { x: 0, y: 1 }, renderItem: drawRow(rows, range, { width, names, isNarrow }) }],
  };
}

function makeNumbers(block, rows) {
  const isRanged = rows.some((row) => row.limits);
  const columns = [{ label: 'step', align: 'left' }, { label: 'change', unit: block.unit, align: 'right' },
    ...(isRanged ? [{ label: 'from', align: 'right' }, { label: 'to', align: 'right' }] : []), { label: 'then at', unit: block.unit, align: 'right' }];
  const cells = rows.map((row) => [row.name, row.isTotal ? '' : row.text,
    ...(isRanged ? (row.limits ? [signed(row.step.low), signed(row.step.high)] : ['', '']) : []), number(row.to)]);
  return makeTable({ caption: block.label || `${block.start.name} to ${block.end.name}`, columns, rows: cells });
}

/// A row for each bar: a value at the ends, else a change.
function makeData({ unit, start, steps, end }) {
  const bars = [start, ...steps, end];
  const values = (key) => bars.map((bar) => bar[key]);
  const limits = steps.some((step) => isNumber(step.low)) ? [column('low', unit, values('low')), column('high', unit, values('high'))] : [];
  return [column('step', '', values('name')), column('kind', '', bars.map((_, i) => (i === 0 || i + 1 === bars.length ? 'value' : 'change'))), column('value', unit, values('value')), ...limits];
}

export function waterfallBlock(block) {
  const rows = makeRows(block);
  const chart = new Chart({
    height: (width) => rows.length * kRow_px[width < kNarrow_px ? 'narrow' : 'wide'] + kTitle_px + 40,
    label: `Waterfall: ${rows.map((row) => `${row.name} ${row.text}`).join(', ')} ${block.unit}. The table below has the numbers.`,
    title: block.label || `${block.start.name} to ${block.end.name}`, data: () => makeData(block),
    makeOption: (width) => makeOption(block, rows, width),
  });
  return figure({ chart, caption: block.caption, table: makeNumbers(block, rows) });
}
