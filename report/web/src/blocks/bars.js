// Bars side by side, or one below the other where there are many: {label, unit, categories: [...],
// series: [{name, values, low, high, labels}], least_end: what the axis goes to at least, caption}
import { axisStyle, axisTitle, baseOption, Chart, figure, makeLegend, tipLine } from '../chart.js';
import { h } from '../dom.js';
import { number } from '../format.js';
import { column } from '../save.js';
import { color } from '../theme.js';
import { makeTable } from './table.js';

/// Filled, hollow and hatched bars differ without color.
function barStyle(k) {
  const tone = color(`series-${(k % 6) + 1}`);
  if (k % 2 === 0) return { color: tone, borderColor: tone, borderWidth: 1 };
  return { color: color('hatch'), borderColor: tone, borderWidth: 1.5,
    decal: { symbol: 'rect', color: tone, dashArrayX: [1, 0], dashArrayY: [2, 4], rotation: -Math.PI / 4 } };
}

const kLeast_px = 70; // width of a category below which bars lie
const isLying = (block, width) => width / block.categories.length < kLeast_px;

const kTick_px = 70; // from one number of a lying axis to the next, at least about so
const kCategoryGap = 0.3, kBarGap = 0.08; // of a category's width, and of a bar's
const widestBar = (lying) => (lying ? 22 : 72);
const kNameLine_px = 12; // of the name of a lying bar
const nameWidth = (width) => Math.min(230, 0.42 * width);
/// How many lines a name takes beside a lying bar, about: a letter has 6 px, and words leave ends of lines empty.
const countLines = (name, width) => Math.ceil((1.2 * 6 * name.length) / nameWidth(width));

/// Intervals as whiskers on the bars of one series.
function whiskers(series, k, count, lying) {
  return {
    type: 'custom', name: series.name, silent: true, z: 5,
    data: series.values.map((_, i) => [i, series.low[i], series.high[i]]).filter((d) => d[1] !== null && d[2] !== null),
    encode: lying ? { y: 0, x: [1, 2] } : { x: 0, y: [1, 2] },
    renderItem: (params, api) => {
      const place = (value) => api.coord(lying ? [value, api.value(0)] : [api.value(0), value]);
      const along = lying ? 0 : 1;
      const band = api.size(lying ? [0, 1] : [1, 0])[1 - along];
      const width = Math.min(widestBar(lying), ((1 - kCategoryGap) * band) / (count + (count - 1) * kBarGap));
      const at = place(api.value(1))[1 - along] + (k - (count - 1) / 2) * width * (1 + kBarGap);
      const [low, high] = [api.value(1), api.value(2)].map((value) => place(value)[along]);
      const line = (a, b, c, d) => (lying ? [b, a, d, c] : [a, b, c, d]);
      const whisker = (stroke, lineWidth) => [line(at, low, at, high), line(at - 4, low, at + 4, low), line(at - 4, high, at + 4, high)]
        .map(([x1, y1, x2, y2]) => ({ type: 'line', shape: { x1, y1, x2, y2 }, style: { stroke, lineWidth } }));
      return { type: 'group', children: [...whisker(color('paper'), 4), ...whisker(color('ink'), 1.5)] };
    },
  };
}

const titleOf = (block) => [block.label, block.unit].filter(Boolean).join(', ');
const legendOf = (block, width) => makeLegend(block.series.map((s) => s.name), { width, itemWidth: 18, itemHeight: 10 });

/// Quantity, unit and every series of a category.
function makeTip(block, index) {
  const value = (series) => [number(series.values[index]), block.unit].filter(Boolean).join(' ');
  const interval = (series) => (series.low && series.low[index] !== null && series.low[index] !== undefined ? tipLine('', `${number(series.low[index])} to ${number(series.high[index])}`) : null);
  return [h('div', null, h('b', null, block.categories[index])), h('div', null, titleOf(block)),
    ...block.series.flatMap((series) => [tipLine(`${series.name}:`, value(series)), interval(series)])].filter(Boolean);
}

function makeOption(block, width) {
  const axis = axisStyle();
  const legend = legendOf(block, width);
  const lying = isLying(block, width);
  const bars = block.series.map((series, k) => ({
    name: series.name, type: 'bar', data: series.values, itemStyle: barStyle(k), barGap: `${100 * kBarGap}%`, barMaxWidth: widestBar(lying), barCategoryGap: `${100 * kCategoryGap}%`,
    label: { show: Boolean(series.labels), position: lying ? 'right' : 'top', fontSize: 11, color: color('ink'), formatter: (p) => series.labels[p.dataIndex] },
  }));
  const names = { ...axis, type: 'category', data: block.categories, inverse: lying, splitLine: { show: false }, axisTick: { show: false },
    axisLabel: { ...axis.axisLabel, formatter: (name) => name.replaceAll('/', '\u2215'), interval: 0, // no break inside of km/h
      hideOverlap: false, width: lying ? nameWidth(width) : width / block.categories.length - 8, overflow: 'break', lineHeight: lying ? kNameLine_px : 14 } };
  const values = { ...axis, type: 'value', axisLine: { show: false }, axisTick: { show: false },
    splitNumber: lying ? Math.max(2, Math.floor((0.6 * width) / kTick_px)) : 5,
    max: block.least_end ? ({ max }) => (max < block.least_end ? block.least_end : null) : null };
  return {
    ...baseOption(),
    tooltip: { ...baseOption().tooltip, trigger: 'axis', axisPointer: { type: 'shadow' }, formatter: (items) => (items.length ? makeTip(block, items[0].dataIndex) : '') },
    legend: legend.option || { show: false },
    title: axisTitle(titleOf(block), legend.height),
    grid: { left: 8, right: lying && block.series.some((one) => one.labels) ? 58 : lying ? 28 : 12, top: legend.height + 34, bottom: 4, containLabel: true },
    xAxis: lying ? values : names,
    yAxis: lying ? names : values,
    series: [...bars, ...block.series.map((s, k) => (s.low ? whiskers(s, k, block.series.length, lying) : null)).filter(Boolean)],
  };
}

/// Lying bars take a height of their own each.
function heightOf(block, width) {
  const legend = legendOf(block, width).height;
  if (!isLying(block, width)) return (width < 600 ? 340 : 300) + legend;
  const lines = Math.max(...block.categories.map((name) => countLines(name, width)));
  return 60 + legend + block.categories.length * Math.max(26, 10 + 16 * block.series.length, 8 + kNameLine_px * lines);
}

function makeNumbers(block) {
  const columns = [{ label: '', align: 'left' }];
  block.series.forEach((s) => {
    columns.push({ label: s.name, unit: block.unit });
    if (s.low) columns.push({ label: 'from' }, { label: 'to' });
    if (s.labels) columns.push({ label: 'note', align: 'right' });
  });
  const rows = block.categories.map((category, i) => [category, ...block.series.flatMap((s) =>
    [s.values[i], ...(s.low ? [s.low[i], s.high[i]] : []), ...(s.labels ? [s.labels[i]] : [])])]);
  return makeTable({ caption: block.label, columns, rows });
}

/// A row for each category.
const makeData = (block) => [column('category', '', block.categories), ...block.series.flatMap((s) => {
  const quantity = block.series.length > 1 ? `${block.label} ${s.name}` : block.label;
  return [column(quantity, block.unit, s.values), ...(s.low ? [column(`${quantity} low`, block.unit, s.low), column(`${quantity} high`, block.unit, s.high)] : []),
    ...(s.labels ? [column(`${quantity} note`, '', s.labels)] : [])];
})];

export function barsBlock(block) {
  const names = block.series.map((s) => s.name).join(' and ');
  const chart = new Chart({
    height: (width) => heightOf(block, width),
    label: `Bar chart: ${block.label}, ${names}, for ${block.categories.join(', ')}. The table below has the numbers.`,
    title: block.label, data: () => makeData(block),
    makeOption: (width) => makeOption(block, width),
  });
  return figure({ chart, caption: block.caption, table: makeNumbers(block) });
}
