// A chart of the page: drawn when it comes near the window, redrawn with the theme and for paper, with a caption and a
// table of the same numbers beside it.
import * as echarts from 'echarts/core';
import { BarChart, CustomChart, LineChart, SankeyChart, ScatterChart } from 'echarts/charts';
import {
  DataZoomComponent,
  GridComponent,
  LegendComponent,
  MarkAreaComponent,
  MarkLineComponent,
  TitleComponent,
  TooltipComponent,
} from 'echarts/components';
import { SVGRenderer } from 'echarts/renderers';
import { h } from './dom.js';
import { saveMenu } from './save.js';
import { color, onThemeChange } from './theme.js';

echarts.use([
  BarChart, CustomChart, LineChart, SankeyChart, ScatterChart, DataZoomComponent, GridComponent, LegendComponent,
  MarkAreaComponent, MarkLineComponent, TitleComponent, TooltipComponent, SVGRenderer,
]);

export const { graphic } = echarts;

/// A line of a tooltip: a name and a value. Tooltips are elements, not HTML as text: names come from files and may hold
/// anything.
export const tipLine = (name, value) => h('div', { class: 'tip' }, h('span', null, name), h('b', null, value));

const all = [];

/// Text and lines that every chart shares.
export function baseOption() {
  return {
    animation: false,
    backgroundColor: 'transparent',
    textStyle: { fontFamily: getComputedStyle(document.body).fontFamily, color: color('ink'), fontSize: 12 },
    tooltip: {
      backgroundColor: color('raised'),
      borderColor: color('rule'),
      textStyle: { color: color('ink'), fontSize: 12 },
      confine: true,
      position: placeTip,
      transitionDuration: 0,
    },
  };
}

export function axisStyle() {
  return {
    axisLine: { show: true, lineStyle: { color: color('axis') } },
    axisTick: { show: true, lineStyle: { color: color('axis') } },
    axisLabel: { color: color('soft'), fontSize: 11, hideOverlap: true, padding: [0, 4] }, // apart where they are drawn
    splitLine: { show: true, lineStyle: { color: color('grid'), width: 1 } },
    nameTextStyle: { color: color('soft'), fontSize: 11 },
  };
}

/// What the upright axis shows, in words above it and below a legend: `legend` is its height in px, or whether it has one line.
export const axisTitle = (text, legend) => ({ text, left: 0, top: typeof legend === 'number' ? legend + 2 : legend ? 26 : 2, padding: 0, textStyle: { fontSize: 12, fontWeight: 400, color: color('soft') } });

const kIcon_px = 26;
const kGap_px = 10;
const kLegendLine_px = 16;
let ruler;

/// Width of a text in the font of the charts.
function textWidth(text, fontSize) {
  ruler = ruler || document.createElement('canvas').getContext('2d');
  ruler.font = `${fontSize}px ${getComputedStyle(document.body).fontFamily}`;
  return ruler.measureText(text).width;
}

/// Lines that a legend of these names takes in a width, one after the other.
function legendLines(names, width, fontSize) {
  let lines = 1;
  let at = 0;
  for (const name of names) {
    const wide = kIcon_px + 5 + textWidth(name, fontSize) + kGap_px;
    if (at > 0 && at + wide > width) {
      lines += 1;
      at = 0;
    }
    at += wide;
  }
  return lines;
}

/// A legend on lines of its own, with all names: {option, height}. None, without height, for a single series.
export function makeLegend(names, { left = 0, top = 0, width, fontSize = 12, ...more }) {
  if (names.length < 2) return { option: null, height: 0 };
  const option = { show: true, left, top, width, padding: 0, itemWidth: kIcon_px, itemHeight: 9, itemGap: kGap_px, data: names,
    textStyle: { color: color('ink'), fontSize, lineHeight: kLegendLine_px, width: width - kIcon_px - 5, overflow: 'truncate' }, inactiveColor: color('axis'), ...more };
  return { option, height: legendLines(names, width, fontSize) * (kLegendLine_px + kGap_px) - kGap_px + 6 };
}

/// Beside the pointer, inside of the chart and of the window.
function placeTip(point, params, tip, rect, { contentSize: [wide, high] }) {
  const chart = tip.parentElement.getBoundingClientRect();
  const within = (at, low, most) => Math.max(low, Math.min(at, most));
  const gap = 14;
  const right = Math.min(chart.right, innerWidth) - chart.left;
  const x = point[0] + gap + wide <= right ? point[0] + gap : point[0] - gap - wide;
  const top = Math.max(0, -chart.top);
  const bottom = Math.min(chart.bottom, innerHeight) - chart.top;
  return [within(x, Math.max(0, -chart.left), right - wide), within(point[1] + gap, top, bottom - high)];
}

export class Chart {
  /// `makeOption(width)` is asked anew for each theme; `height` in px, or of the width. `title` and `data()`, the columns
  /// of its CSV, are for saving.
  constructor({ height, makeOption, label, title, data, afterDraw }) {
    this.title = title;
    this.data = data;
    this.makeOption = makeOption;
    this.height = typeof height === 'function' ? height : () => height;
    this.afterDraw = afterDraw;
    this.element = h('div', { class: 'chart', role: 'img', 'aria-label': label });
    this.element.style.height = `${this.height(800)}px`;
    this.instance = null;
    this.less_px = 0; // by which it is lower on paper
    all.push(this);
    this.leaveTheme = onThemeChange(() => this.redraw());
    watchNear.observe(this.element);
    watchSize.observe(this.element);
  }

  draw() {
    if (this.instance || !this.element.isConnected || this.element.clientWidth === 0) return;
    this.width = this.element.clientWidth;
    this.element.style.height = `${this.height(this.width) - this.less_px}px`;
    this.instance = echarts.init(this.element, null, { renderer: 'svg' });
    this.instance.setOption(this.makeOption(this.width));
    this.instance.getZr().flush();
    if (this.afterDraw) this.afterDraw(this);
  }

  redraw() {
    if (!this.instance) return;
    const zoom = this.zoom();
    this.instance.dispatchAction({ type: 'hideTip' }); // it would be shown anew in what is no longer there
    this.width = this.element.clientWidth;
    this.element.style.height = `${this.height(this.width) - this.less_px}px`;
    this.instance.resize({ animation: { duration: 0 } });
    this.instance.setOption(this.makeOption(this.width), { notMerge: true });
    if (zoom) this.instance.dispatchAction({ type: 'dataZoom', startValue: zoom[0], endValue: zoom[1] });
    this.instance.getZr().flush();
    if (this.afterDraw) this.afterDraw(this);
  }

  /// Draws what has changed in the data, at the same size and zoom. The series must be those of before. With
  /// `isAsked(series)`, only those of them are drawn again.
  refresh(isAsked) {
    if (!this.instance) return;
    const { dataZoom, ...option } = this.makeOption(this.width);
    this.instance.setOption(isAsked ? { series: option.series.filter(isAsked) } : option);
    this.instance.getZr().flush();
    if (this.afterDraw) this.afterDraw(this);
  }

  /// The chart as it is drawn now; it is drawn first where it has not been in sight.
  picture() {
    this.draw();
    return { svg: this.element.querySelector('svg'), width: this.instance.getWidth(), height: this.instance.getHeight() };
  }

  /// Range shown, where the chart can be zoomed.
  zoom() {
    const option = this.instance && this.instance.getOption();
    const zoom = option && option.dataZoom && option.dataZoom[0];
    return zoom ? [zoom.startValue, zoom.endValue] : null;
  }
}

const chartOf = (element) => all.find((chart) => chart.element === element);
const watchNear = new IntersectionObserver(
  (entries) => entries.forEach((entry) => entry.isIntersecting && chartOf(entry.target).draw()),
  { rootMargin: '600px' },
);
const watchSize = new ResizeObserver((entries) =>
  entries.forEach((entry) => {
    const chart = chartOf(entry.target);
    if (chart.instance && Math.abs(chart.element.clientWidth - chart.width) > 1) chart.redraw();
  }),
);

/// Charts within an element.
export const chartsIn = (element) => all.filter((chart) => element.contains(chart.element));

/// To be called when an element goes: its charts go with it.
export function forgetChartsIn(element) {
  for (const chart of chartsIn(element)) {
    watchNear.unobserve(chart.element);
    watchSize.unobserve(chart.element);
    chart.leaveTheme();
    if (chart.instance) chart.instance.dispose();
    all.splice(all.indexOf(chart), 1);
  }
}

/// All charts at the width that they have now, those out of sight too: for paper and for tests.
export function drawAll() {
  all.forEach((chart) => (chart.instance ? chart.redraw() : chart.draw()));
}
export const chartCount = () => all.filter((chart) => chart.instance).length;

/// Shows the tooltip of the first point of each series, one after the other. Returns their HTML, for tests.
export function showTips() {
  return all.filter((chart) => chart.instance).flatMap((chart) => chart.instance.getOption().series.map((_, seriesIndex) => {
    chart.instance.dispatchAction({ type: 'showTip', seriesIndex, dataIndex: 0 });
    return [...chart.element.children].slice(1).map((tip) => tip.innerHTML).join('');
  }));
}

export const chartAt = (element) => all.find((chart) => chart.element === element && chart.instance);

/// Boxes of each legend and each plot of a chart in the window, in pairs: for tests.
export function legendsAndPlots({ instance, element }) {
  const frame = element.getBoundingClientRect();
  const inWindow = ({ x, y, width, height }) => ({ left: frame.left + x, top: frame.top + y, right: frame.left + x + width, bottom: frame.top + y + height });
  const boxes = [];
  instance.getModel().eachComponent('legend', (model) => {
    const { group } = instance.getViewOfComponentModel(model);
    const box = group.getBoundingRect().clone();
    box.applyTransform(group.transform || group.getLocalTransform());
    if (model.get('show') && box.width > 0) boxes.push({ name: model.get('data').map((one) => one.name || one).join(', '), legend: inWindow(box) });
  });
  const plots = [];
  instance.getModel().eachComponent('grid', (model) => plots.push(inWindow(model.coordinateSystem.getRect())));
  return boxes.flatMap((one) => plots.map((plot) => ({ ...one, plot })));
}

/// What stands below a chart: the numbers as a table that opens, and the menu that saves it.
export const chartFoot = (chart, table) => h('div', { class: 'chartfoot' },
  table && h('details', { class: 'numbers' }, h('summary', null, 'Numbers of this chart as a table'), table),
  saveMenu({ title: chart.title, data: () => chart.data(), picture: () => chart.picture() }));

/// A figure: chart, caption, and what stands below it.
export function figure({ chart, caption, table, before }) {
  return h('figure', null, before, chart.element, caption && h('figcaption', null, caption), chartFoot(chart, table));
}
