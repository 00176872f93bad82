// Channels over time: panels one above the other on one axis, phases shaded, a cursor at the page's time.
//
// {title, view: [from_s, to_s], phases: [{name, start_s, end_s}],
//  rows: [[start_s, step_s, number], ...], panels: [{label, unit, scale: [from, to], series: [{name, t, y, points, held, recorded, phases}]}]}
// held: times of points that are drawn, but are no rows.
// Of a recording the values in numbers are those of its rows (rows, recorded, phases), not of the lines.
import { axisStyle, baseOption, Chart, chartFoot, forgetChartsIn, graphic, tipLine } from '../chart.js';
import { h } from '../dom.js';
import { recordedAt, rowAt, rowTimes, valueAt } from '../clock.js';
import { clockTime, number, timeUnit } from '../format.js';
import { column } from '../save.js';
import { color, isOnPaper, onPaperChange, seriesStyle } from '../theme.js';
import { chooseLegends, divideForPaper, kFewLabels_px, kFoot, kLeft, kRight, kStrip, legendOf, limits, lowAxis, panelsBottom, placePanels, uniqueName } from './panels.js';
import { makePhaseTable } from './phase_table.js';

function findSpan(block) {
  const ends = block.panels.flatMap((panel) => panel.series.filter((s) => s.t.length).map((s) => [s.t[0], s.t.at(-1)]));
  return [Math.min(...ends.map((e) => e[0])), Math.max(...ends.map((e) => e[1]))];
}

/// Names of the phases as a row of boxes, each cut to its width.
function phaseStrip(phases, unit) {
  return {
    type: 'custom',
    xAxisIndex: 0,
    yAxisIndex: 0,
    silent: true,
    clip: true,
    data: phases.map((p, i) => [p.start_s / unit.seconds, p.end_s / unit.seconds, i]),
    encode: { x: [0, 1] },
    renderItem: (params, api) => {
      const [x0] = api.coord([api.value(0), 0]);
      const [x1] = api.coord([api.value(1), 0]);
      const area = params.coordSys;
      const box = graphic.clipRectByRect({ x: x0, y: area.y, width: x1 - x0, height: area.height }, area);
      if (!box || box.width < 0.5) return undefined;
      const i = api.value(2);
      const name = phases[i].name;
      return {
        type: 'group',
        children: [
          { type: 'rect', shape: box, style: { fill: color(i % 2 ? 'phase-b' : 'phase-a'), stroke: color('axis'), lineWidth: 0.5 } },
          box.width - 8 > Math.min(6.2 * name.length, 44) && { // a letter or two say nothing
            type: 'text',
            style: { x: box.x + 4, y: area.y + area.height / 2, text: name, width: box.width - 8, overflow: 'truncate',
              ellipsis: '\u2026', verticalAlign: 'middle', fontSize: 11, fill: color('ink') },
          },
        ].filter(Boolean),
      };
    },
  };
}

function phaseShading(phases, unit) {
  return {
    silent: true,
    itemStyle: { color: color('phase-shade') },
    data: phases.filter((_, i) => i % 2 === 1).map((p) => [{ xAxis: p.start_s / unit.seconds }, { xAxis: p.end_s / unit.seconds }]),
  };
}

function makeSeries(panel, series, index, k, unit, phases) {
  const line = panel.series.slice(0, k).filter((one) => !one.points).length; // points take no line's style
  const style = seriesStyle(line);
  const isPoints = series.points;
  return {
    name: uniqueName(panel, series),
    type: isPoints ? 'scatter' : 'line',
    xAxisIndex: index + 1,
    yAxisIndex: index + 1,
    data: series.t.map((t, n) => [t / unit.seconds, series.y[n]]),
    showSymbol: false,
    symbolSize: isPoints ? 3 : 0,
    symbol: isPoints ? 'circle' : 'none',
    z: isPoints ? 1 : 3,
    itemStyle: { color: isPoints ? color('soft') : style.color, opacity: isPoints ? 0.55 : 1 },
    lineStyle: { color: style.color, width: 1.6, type: style.type },
    step: series.step ? 'end' : false,
    markArea: k === 0 ? phaseShading(phases, unit) : undefined,
    markLine: k === 0 && series.zero ? { silent: true, symbol: 'none', label: { show: false }, lineStyle: { color: color('axis'), type: 'solid' }, data: [{ yAxis: 0 }] } : undefined,
  };
}

/// All series of the panel under the pointer. Of a recording: the values of the last row at or before the pointer. Of other
/// series: their points nearest to it.
function makeTooltip(block, unit, hovered) {
  const times_s = block.rows && rowTimes(block.rows);
  const phaseAt = (at_s) => (block.phases || []).find((phase) => at_s >= phase.start_s - 1e-6 && at_s < phase.end_s);
  const head = (panel, at_s) => [h('div', null, h('b', null, `${panel.label}, ${panel.unit}`)),
    h('div', null, [clockTime(at_s), phaseAt(at_s) && phaseAt(at_s).name].filter(Boolean).join(' \u00b7 '))];
  const line = (series, panel, value) => tipLine(`${series.name}:`, `${number(value)} ${panel.unit}`);
  return (items) => {
    if (!items.length) return '';
    const time_s = items[0].axisValue * unit.seconds;
    const panel = block.panels[hovered()];
    if (times_s) {
      const row = rowAt(times_s, time_s);
      const value = (series) => (series.recorded ? recordedAt(series.recorded, row, times_s) : valueAt(series, times_s[row]));
      return [...head(panel, times_s[row]), ...panel.series.map((series) => line(series, panel, value(series)))];
    }
    return [...head(panel, time_s), ...panel.series.map((series) => {
      const item = items.find((one) => one.seriesName === uniqueName(panel, series) && one.value[1] !== null);
      return line(series, panel, item ? item.value[1] : valueAt(series, time_s));
    })];
  };
}

function makeOption(block, span, unit, width, hovered) {
  const axis = axisStyle();
  const view = (block.view || span).map((t) => t / unit.seconds);
  const grids = [{ left: kLeft, right: kRight, top: 0, height: kStrip }];
  const xAxes = [{ type: 'value', gridIndex: 0, show: false, min: span[0] / unit.seconds, max: span[1] / unit.seconds, axisPointer: { show: false } }];
  const yAxes = [{ type: 'value', gridIndex: 0, show: false, min: 0, max: 1 }];
  const titles = [];
  const legends = [];
  const series = [phaseStrip(block.phases || [], unit)];
  const places = placePanels(block, width);
  const hasLegend = chooseLegends(block.panels, width);
  block.panels.forEach((panel, i) => {
    const last = i === block.panels.length - 1;
    const { top, height, title, legend } = places[i];
    grids.push({ left: kLeft, right: kRight, top, height });
    xAxes.push({
      ...axis, type: 'value', gridIndex: i + 1, min: xAxes[0].min, max: xAxes[0].max,
      axisLine: { ...axis.axisLine, onZero: false }, axisTick: { ...axis.axisTick, show: last },
      axisLabel: { ...axis.axisLabel, show: last, showMinLabel: false, showMaxLabel: false, formatter: (v) => number(v, 6).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '') },
      name: last ? `Time, ${unit.symbol}` : '', nameLocation: 'middle', nameGap: 22, splitLine: { show: false },
      axisPointer: { snap: false, lineStyle: { color: color('soft'), type: 'solid', width: 1 }, label: { show: false } },
    });
    yAxes.push({ ...axis, type: 'value', gridIndex: i + 1, scale: true, splitNumber: 3, axisLine: { ...axis.axisLine, onZero: false }, min: (v) => limits(v, panel.scale).min, max: (v) => limits(v, panel.scale).max,
      ...(height < kFewLabels_px ? lowAxis(panel, height) : {}),
      axisLabel: { ...axis.axisLabel, showMaxLabel: panel.scale ? false : undefined, formatter: (v) => number(v, 6).replace(/(\.\d*?)0+$/, '$1').replace(/\.$/, '') } });
    titles.push({ left: kLeft - 4, top: title, padding: 0,
      text: `{b|${panel.label}} {u|${panel.unit}}`,
      textStyle: { fontSize: 12, color: color('ink'), rich: { b: { fontWeight: 600, fontSize: 12, color: color('ink') }, u: { fontSize: 12, color: color('soft') } } } });
    const { option } = legendOf(panel, width);
    if (option && hasLegend[i]) legends.push({ ...option, top: legend });
    panel.series.forEach((one, k) => series.push(makeSeries(panel, one, i, k, unit, block.phases || [])));
  });
  const allX = xAxes.map((_, i) => i);
  return {
    ...baseOption(),
    tooltip: { ...baseOption().tooltip, trigger: 'axis', formatter: makeTooltip(block, unit, hovered) },
    axisPointer: { link: [{ xAxisIndex: allX.slice(1) }] },
    title: titles, legend: legends, grid: grids, xAxis: xAxes, yAxis: yAxes,
    dataZoom: [
      { type: 'slider', show: !isOnPaper(), xAxisIndex: allX, startValue: view[0], endValue: view[1], bottom: 4, height: 16, left: kLeft, right: kRight,
        showDataShadow: false, showDetail: false, brushSelect: false, filterMode: 'none', borderColor: color('rule'),
        fillerColor: color('phase-a'), handleStyle: { color: color('raised'), borderColor: color('axis') }, moveHandleSize: 4, moveHandleStyle: { color: color('axis') } },
      { type: 'inside', xAxisIndex: allX, startValue: view[0], endValue: view[1], filterMode: 'none', zoomOnMouseWheel: 'ctrl', moveOnMouseWheel: false },
    ],
    series,
  };
}

function placeCursor(chart, cursor, clock, unit, block) {
  cursor.style.height = `${panelsBottom(block, chart.width)}px`;
  const x = chart.instance.convertToPixel({ xAxisIndex: 1 }, clock.now_s / unit.seconds);
  const inside = x >= kLeft - 1 && x <= chart.width - kRight + 1;
  cursor.style.display = inside ? '' : 'none';
  cursor.style.transform = `translateX(${x}px)`;
}

const makeCursor = () => h('div', { class: 'cursor', 'aria-hidden': 'true' });

/// The charts of a block for paper, in an element of their own.
function makePaperCharts(block, span, unit, clock) {
  return divideForPaper(block).map((part) => {
    const chart = new Chart({ height: (width) => panelsBottom(part, width) + 40, label: '', title: '', data: () => [], makeOption: (width) => makeOption(part, span, unit, width, () => 0) });
    const cursor = clock && !block.unlinked && makeCursor();
    if (cursor) chart.afterDraw = () => placeCursor(chart, cursor, clock, unit, part);
    return h('div', { class: 'times part' }, chart.element, cursor);
  });
}

/// The cursor at the page's time, over all panels; dragging on the chart moves the time.
function tieToClock(chart, cursor, clock, unit, block, afterDraw) {
  const place = () => {
    if (!chart.instance) return;
    placeCursor(chart, cursor, clock, unit, block);
  };
  clock.onChange(place);
  chart.afterDraw = () => {
    afterDraw();
    place();
    if (chart.isTied) return;
    chart.isTied = true;
    chart.instance.on('datazoom', place);
    chart.instance.getZr().on('click', (event) => {
      if (event.offsetX < kLeft || event.offsetY > panelsBottom(block, chart.width)) return;
      clock.set(chart.instance.convertFromPixel({ xAxisIndex: 1 }, event.offsetX) * unit.seconds);
    });
  };
}

/// A row for each time at which a series has a point, and a column for each series. The series of a recording have the
/// names of its channels; others have the name of their panel before their own where that does not say it.
function makeData(block) {
  const all = block.panels.flatMap((panel) => panel.series.map((series) => ({ panel, series, values: new Map(series.t.map((t, i) => [t, series.y[i]]).filter(([t]) => !series.held?.includes(t))) })));
  const isOwnName = Boolean(block.rows) && new Set(all.map(({ series }) => series.name)).size === all.length;
  const name = (panel, series) => (isOwnName || series.name.toLowerCase().includes(panel.label.toLowerCase()) ? series.name : `${panel.label} ${series.name}`);
  const times_s = [...new Set(all.flatMap(({ values }) => [...values.keys()]))].sort((a, b) => a - b);
  return [column('time', 's', times_s), ...all.map(({ panel, series, values }) =>
    column(name(panel, series), panel.unit, times_s.map((t) => values.get(t) ?? null)))];
}

export function timesBlock(block, { clock }) {
  const span = findSpan(block);
  const unit = timeUnit((block.view || span)[1] - (block.view || span)[0]);
  const names = block.panels.map((panel) => panel.label.toLowerCase()).join(', ');
  let pointer_px = 0;
  const hovered = () => {
    const below = placePanels(block, chart.width).findIndex(({ top, height }) => pointer_px < top + height);
    return below < 0 ? block.panels.length - 1 : below;
  };
  const chart = new Chart({
    height: (width) => panelsBottom(block, width) + kFoot,
    label: `Line charts over time from ${clockTime(span[0])} to ${clockTime(span[1])}: ${names}. The table below has mean and extremes of each phase.`,
    title: block.title || 'Over time', data: () => makeData(block),
    makeOption: (width) => makeOption(block, span, unit, width, hovered),
  });
  const followPointer = () => {
    if (chart.isFollowed) return;
    chart.isFollowed = true;
    chart.instance.getZr().on('mousemove', (event) => (pointer_px = event.offsetY));
  };
  chart.afterDraw = followPointer;
  const holder = h('div', { class: 'times' }, chart.element);
  const onPaper = h('div');
  onPaperChange((isPaper) => {
    holder.hidden = isPaper;
    forgetChartsIn(onPaper);
    const zoom = chart.zoom();
    const view = zoom ? zoom.map((at) => at * unit.seconds) : block.view;
    onPaper.replaceChildren(...(isPaper && holder.isConnected ? makePaperCharts({ ...block, view }, span, unit, clock) : []));
  });
  if (clock && !block.unlinked) {
    const cursor = makeCursor();
    holder.append(cursor);
    tieToClock(chart, cursor, clock, unit, block, followPointer);
  }
  const zoom = (range) => chart.instance && chart.instance.dispatchAction({ type: 'dataZoom', startValue: range[0] / unit.seconds, endValue: range[1] / unit.seconds });
  const choice = h('div', { class: 'zoom' },
    h('label', null, 'Show ', h('select', { onchange: (event) => zoom(JSON.parse(event.target.value)) },
      block.view && h('option', { value: JSON.stringify(block.view), selected: true }, 'from the start of rolling'),
      h('option', { value: JSON.stringify(span) }, 'the whole time'),
      (block.phases || []).map((p) => h('option', { value: JSON.stringify([p.start_s, p.end_s]) }, p.name)))));
  return h('figure', { class: 'timesfigure' }, h('div', { class: 'charthead' }, h('h3', null, block.title || ''), choice), holder, onPaper, block.caption && h('figcaption', null, block.caption),
    chartFoot(chart, makePhaseTable(block, span)));
}
