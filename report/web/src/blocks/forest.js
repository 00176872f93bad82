// Estimates beside what was known before, a row each, in percent of the estimate from it:
// {label, names: [estimate, prior], rows: [{name, unit, value, low, high, prior: {value, low, high}}], caption}
import { axisStyle, axisTitle, baseOption, Chart, figure, makeLegend, tipLine } from '../chart.js';
import { h } from '../dom.js';
import { number } from '../format.js';
import { column } from '../save.js';
import { isOnPaper, seriesStyle } from '../theme.js';
import { makeTable } from './table.js';

const rowHeight = () => (isOnPaper() ? 22 : 36);
const kFoot_px = 44;
const kTitle_px = 30;
const kTick_px = 80; // from one number of the axis to the next, at least about so

const withUnit = (row, value) => [number(value), row.unit].filter(Boolean).join(' ');
/// Of the estimate; where that is 0, of the prior.
const sizeOf = (row) => Math.abs(row.value || row.prior?.value || 0);
const percent = (row, value) => (100 * (value - row.value)) / sizeOf(row);
const legendOf = (block, width) => makeLegend(block.names, { width, itemWidth: 14 });

/// Interval and value of one of the two on each row; the estimate above the prior.
function makeIntervals(block, k) {
  const style = seriesStyle(k);
  const of = (row) => (k === 0 ? row : row.prior);
  const rows = block.rows.map((row, i) => [row, i]).filter(([row]) => of(row) && sizeOf(row) > 0);
  return {
    name: block.names[k], type: 'custom', itemStyle: { color: style.color }, encode: { x: [0, 2, 3], y: 1 },
    data: rows.map(([row, i]) => [percent(row, of(row).value), i, percent(row, of(row).low), percent(row, of(row).high)]),
    renderItem: (params, api) => {
      const shift = (k === 0 ? -0.16 : 0.16) * api.size([0, 1])[1];
      const [x, y] = api.coord([api.value(0), api.value(1)]);
      const [low] = api.coord([api.value(2), api.value(1)]);
      const [high] = api.coord([api.value(3), api.value(1)]);
      const at = y + shift;
      const mark = k === 0 ? { type: 'circle', shape: { cx: x, cy: at, r: 4.5 }, style: { fill: style.color } }
        : { type: 'rect', shape: { x: x - 4, y: at - 4, width: 8, height: 8 }, style: { fill: 'none', stroke: style.color, lineWidth: 1.5 } };
      return { type: 'group', children: [
        { type: 'line', shape: { x1: low, y1: at, x2: high, y2: at }, style: { stroke: style.color, lineWidth: k === 0 ? 2.5 : 1.5, lineDash: k === 0 ? null : [5, 3] } }, mark] };
    },
  };
}

function makeTip(block, row) {
  const lines = (name, one) => [tipLine(`${name}:`, withUnit(row, one.value)), tipLine('95 %:', `${number(one.low)} to ${number(one.high)}`)];
  return [h('div', null, h('b', null, row.name)), ...lines(block.names[0], row), ...(row.prior ? lines(block.names[1], row.prior) : [])];
}

function makeOption(block, width) {
  const axis = axisStyle();
  const legend = legendOf(block, width);
  return {
    ...baseOption(),
    tooltip: { ...baseOption().tooltip, trigger: 'item', formatter: (item) => makeTip(block, block.rows[item.value[1]]) },
    legend: legend.option || { show: false },
    title: axisTitle(block.label, legend.height),
    grid: { left: 8, right: 16, top: legend.height + kTitle_px, bottom: kFoot_px - 18, containLabel: true },
    xAxis: { ...axis, type: 'value', splitNumber: Math.max(2, Math.floor((0.6 * width) / kTick_px)), name: '% from the estimate', nameLocation: 'middle', nameGap: 26, axisLabel: { ...axis.axisLabel, formatter: (v) => number(v, 3).replace(/\.0+$/, '') } },
    yAxis: { ...axis, type: 'category', inverse: true, data: block.rows.map((row) => row.name), splitLine: { show: false }, axisTick: { show: false },
      axisLabel: { ...axis.axisLabel, interval: 0, hideOverlap: false, width: Math.min(220, 0.36 * width), overflow: 'break', lineHeight: 12 } },
    series: [makeIntervals(block, 1), makeIntervals(block, 0)],
  };
}

function makeNumbers(block) {
  const columns = ['', 'unit', block.names[0], 'from', 'to', block.names[1], 'from', 'to'].map((label, i) => ({ label, align: i < 2 ? 'left' : 'right' }));
  const of = (one) => (one ? [one.value, one.low, one.high] : [null, null, null]);
  return makeTable({ caption: block.label, columns, rows: block.rows.map((row) => [row.name, row.unit, ...of(row), ...of(row.prior)]) });
}

/// A row for each number, its own unit beside it.
function makeData({ rows, names }) {
  const of = (one, key) => rows.map((row) => one(row)?.[key] ?? null);
  const columns = (name, one) => [column(name, '', of(one, 'value')), column(`${name} low`, '', of(one, 'low')), column(`${name} high`, '', of(one, 'high'))];
  return [column('name', '', rows.map((row) => row.name)), column('unit', '', rows.map((row) => row.unit)),
    ...columns(names[0], (row) => row), ...columns(names[1], (row) => row.prior)];
}

export function forestBlock(block) {
  const chart = new Chart({
    height: (width) => legendOf(block, width).height + kTitle_px + rowHeight() * block.rows.length + kFoot_px,
    label: `${block.label}: ${block.rows.map((row) => `${row.name} ${withUnit(row, row.value)}`).join(', ')}. The table below has the numbers.`,
    title: block.label, data: () => makeData(block),
    makeOption: (width) => makeOption(block, width),
  });
  return figure({ chart, caption: block.caption, table: makeNumbers(block) });
}
