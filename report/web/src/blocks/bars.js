// Bars side by side: {label, unit, categories: [...], series: [{name, values, low, high}], caption}
import { axisStyle, axisTitle, baseOption, Chart, figure } from '../chart.js';
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

/// Intervals as whiskers on the bars of one series.
function whiskers(series, k, count) {
  return {
    type: 'custom', name: series.name, silent: true, z: 5,
    data: series.values.map((_, i) => [i, series.low[i], series.high[i]]).filter((d) => d[1] !== null && d[2] !== null),
    encode: { x: 0, y: [1, 2] },
    renderItem: (params, api) => {
      const [x, low] = api.coord([api.value(0), api.value(1)]);
      const [, high] = api.coord([api.value(0), api.value(2)]);
      const band = api.size([1, 0])[0];
      const at = x + (k - (count - 1) / 2) * ((0.7 * band) / count);
      const whisker = (stroke, lineWidth) => [[at, low, at, high], [at - 4, low, at + 4, low], [at - 4, high, at + 4, high]]
        .map(([x1, y1, x2, y2]) => ({ type: 'line', shape: { x1, y1, x2, y2 }, style: { stroke, lineWidth } }));
      return { type: 'group', children: [...whisker(color('paper'), 4), ...whisker(color('ink'), 1.5)] };
    },
  };
}

function makeOption(block, width) {
  const axis = axisStyle();
  const crowded = width / block.categories.length < 70;
  const bars = block.series.map((series, k) => ({
    name: series.name, type: 'bar', data: series.values, itemStyle: barStyle(k), barGap: '8%', barMaxWidth: 72, barCategoryGap: '30%',
    label: { show: Boolean(series.labels) && !crowded, position: 'top', fontSize: 11, color: color('ink'), formatter: (p) => series.labels[p.dataIndex] },
  }));
  return {
    ...baseOption(),
    tooltip: { ...baseOption().tooltip, trigger: 'axis', axisPointer: { type: 'shadow' }, valueFormatter: (v) => (Array.isArray(v) ? '' : `${number(v)} ${block.unit}`) },
    legend: { show: block.series.length > 1, top: 0, left: 0, padding: 0, itemWidth: 18, itemHeight: 10, textStyle: { color: color('ink'), fontSize: 12 }, data: block.series.map((s) => s.name) },
    title: axisTitle(`${block.label}, ${block.unit}`, block.series.length > 1),
    grid: { left: 8, right: 8, top: block.series.length > 1 ? 58 : 34, bottom: 4, containLabel: true },
    xAxis: { ...axis, type: 'category', data: block.categories, splitLine: { show: false }, axisTick: { show: false },
      axisLabel: { ...axis.axisLabel, formatter: (name) => name.replaceAll('/', '\u2215'), interval: 0, // no break inside of km/h
        hideOverlap: false, rotate: crowded ? 50 : 0, width: crowded ? 90 : width / block.categories.length - 8, overflow: crowded ? 'truncate' : 'break', lineHeight: 14 } },
    yAxis: { ...axis, type: 'value',       axisLine: { show: false }, axisTick: { show: false } },
    series: [...bars, ...block.series.map((s, k) => (s.low ? whiskers(s, k, block.series.length) : null)).filter(Boolean)],
  };
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
    height: (width) => (width < 600 ? 360 : 320),
    label: `Bar chart: ${block.label}, ${names}, for ${block.categories.join(', ')}. The table below has the numbers.`,
    title: block.label, data: () => makeData(block),
    makeOption: (width) => makeOption(block, width),
  });
  return figure({ chart, caption: block.caption, table: makeNumbers(block) });
}
