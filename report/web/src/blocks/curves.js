// Curves and points over a quantity that is not time:
// {x: {label, unit}, y: {label, unit}, series: [{name, kind: line | steps | points, x, y, low, high, style}], caption}
// A line's low and high are a band, those of points are whiskers. Series of one `style` (0, 1, ...) have one color;
// without it, each has its own.
import { axisStyle, axisTitle, baseOption, Chart, figure, makeLegend, tipLine } from '../chart.js';
import { h } from '../dom.js';
import { number } from '../format.js';
import { column } from '../save.js';
import { color, seriesStyle } from '../theme.js';
import { makeTable } from './table.js';

// Seven, of which no multiple is that of the six colors: 42 series of points are told apart.
const kSymbols = ['circle', 'rect', 'triangle', 'diamond', 'emptyCircle', 'emptyRect', 'emptyTriangle'];

function whiskers(series, style) {
  return {
    type: 'custom', name: series.name, silent: true, z: 2,
    data: series.x.map((x, i) => [x, series.low[i], series.high[i]]).filter((d) => d[1] !== null && d[2] !== null),
    encode: { x: 0, y: [1, 2] },
    renderItem: (params, api) => {
      const [x, low] = api.coord([api.value(0), api.value(1)]);
      const [, high] = api.coord([api.value(0), api.value(2)]);
      return { type: 'line', shape: { x1: x, y1: low, x2: x, y2: high }, style: { stroke: style.color, lineWidth: 1.2 } };
    },
  };
}

function band(series, style) {
  return {
    type: 'custom', name: series.name, silent: true, z: 0, clip: true,
    data: [[series.x[0], series.low[0]]],
    renderItem: (params, api) => {
      const points = [...series.x.map((x, i) => api.coord([x, series.high[i]])), ...series.x.map((x, i) => api.coord([x, series.low[i]])).reverse()];
      return { type: 'polygon', shape: { points }, style: { fill: style.color, opacity: 0.16 } };
    },
  };
}

function makeSeries(series, k) {
  const look = series.style ?? k;
  const style = seriesStyle(look);
  const isLine = series.kind !== 'points';
  const main = {
    name: series.name, type: isLine ? 'line' : 'scatter', data: series.x.map((x, i) => [x, series.y[i]]), z: isLine ? 3 : 4,
    step: series.kind === 'steps' ? 'end' : false, showSymbol: isLine && series.x.length <= 25, symbol: isLine && series.style !== undefined ? 'none' : kSymbols[look % kSymbols.length], symbolSize: isLine ? 6 : series.x.length > 400 ? 3 : 6,
    itemStyle: { color: style.color, opacity: !isLine && series.x.length > 400 ? 0.5 : 1 }, lineStyle: { color: style.color, type: style.type, width: 1.8 },
  };
  if (!series.low) return [main];
  return [main, isLine ? band(series, style) : whiskers(series, style)];
}

const legendOf = (block, width) => makeLegend(block.series.map((s) => s.name), { width, itemWidth: block.series.every((s) => s.kind !== 'points') ? 26 : 14 });

const nameOf = (q) => (q.unit ? `${q.label}, ${q.unit}` : q.label);

/// The point of a series that is nearest to a place; null where none is near, in a chart of this range.
function findNearest(series, at, range) {
  const distance = (i) => Math.abs(series.x[i] - at);
  let best = -1;
  series.x.forEach((x, i) => { if (Number.isFinite(x) && series.y[i] !== null && (best < 0 || distance(i) < distance(best))) best = i; });
  return best >= 0 && distance(best) <= 0.05 * range ? best : null;
}

/// Quantity, unit and the nearest point of every series; where it is elsewhere than the pointer, its place.
function makeTip(block, at) {
  const all = block.series.flatMap((s) => s.x);
  const range = Math.max(...all) - Math.min(...all) || 1;
  const line = (series) => {
    const i = findNearest(series, at, range);
    if (i === null) return null;
    const interval = series.low && series.low[i] !== null ? ` (${number(series.low[i])} to ${number(series.high[i])})` : '';
    const place = Math.abs(series.x[i] - at) > 0.002 * range ? ` at ${number(series.x[i])}` : '';
    return tipLine(`${series.name}:`, number(series.y[i]) + interval + place);
  };
  return [h('div', null, h('b', null, nameOf(block.y))), tipLine(`${nameOf(block.x)}:`, number(at)), ...block.series.map(line)].filter(Boolean);
}

function makeOption(block, width) {
  const axis = axisStyle();
  const name = nameOf;
  const lines = [
    ...(block.marks || []).map((mark) => ({ yAxis: mark })),
    ...(block.diagonal ? [[{ coord: [0, 0] }, { coord: [block.diagonal, block.diagonal] }]] : []),
  ];
  const legend = legendOf(block, width);
  const series = block.series.flatMap(makeSeries);
  if (lines.length) series[0].markLine = { silent: true, symbol: 'none', label: { show: false }, lineStyle: { color: color('axis'), type: [4, 4] }, data: lines };
  return {
    ...baseOption(),
    tooltip: { ...baseOption().tooltip, trigger: 'axis', formatter: (items) => (items.length ? makeTip(block, items[0].axisValue) : '') },
    legend: legend.option || { show: false },
    title: axisTitle(name(block.y), legend.height),
    grid: { left: 8, right: 16, top: legend.height + 30, bottom: 26, containLabel: true },
    xAxis: { ...axis, type: 'value', scale: !block.x.from_zero, name: name(block.x), nameLocation: 'middle', nameGap: 26, splitLine: { show: false } },
    yAxis: { ...axis, type: 'value', scale: !block.y.from_zero },
    series,
  };
}

function makeNumbers(block) {
  const columns = [{ label: 'series', align: 'left' }, { label: block.x.label, unit: block.x.unit }, { label: block.y.label, unit: block.y.unit }];
  const isRanged = block.series.some((s) => s.low);
  if (isRanged) columns.push({ label: 'from' }, { label: 'to' });
  const kMost = 60; // rows a series; every so many-th point of longer ones
  const rows = block.series.flatMap((s) => {
    const step = Math.ceil(s.x.length / kMost);
    return s.x.map((x, i) => [s.name, x, s.y[i], ...(isRanged ? [s.low ? s.low[i] : '', s.high ? s.high[i] : ''] : [])]).filter((_, i) => i % step === 0);
  });
  return makeTable({ caption: `${block.y.label} over ${block.x.label}`, columns, rows });
}

/// A row for each point; the series of a point stands in the first column.
function makeData(block) {
  const all = (key) => block.series.flatMap((s) => s.x.map((_, i) => (s[key] ? s[key][i] : null)));
  const isRanged = block.series.some((s) => s.low);
  return [column('series', '', block.series.flatMap((s) => s.x.map(() => s.name))), column(block.x.label, block.x.unit, all('x')), column(block.y.label, block.y.unit, all('y')),
    ...(isRanged ? [column(`${block.y.label} low`, block.y.unit, all('low')), column(`${block.y.label} high`, block.y.unit, all('high'))] : [])];
}

export function curvesBlock(block) {
  const chart = new Chart({
    height: (width) => block.height || 310 + legendOf(block, width).height,
    label: `Chart of ${block.y.label} over ${block.x.label}: ${block.series.map((s) => s.name).join(', ')}. The table below has the numbers.`,
    title: `${block.y.label} over ${block.x.label}`, data: () => makeData(block),
    makeOption: (width) => makeOption(block, width),
  });
  return figure({ chart, caption: block.caption, table: makeNumbers(block) });
}
