// Where the panels of a chart over time lie, with their legends and upright axes; on the screen one below the other, on paper
// in several charts.
import { makeLegend } from '../chart.js';
import { isOnPaper } from '../theme.js';

export const kLeft = 62;
export const kRight = 14;
export const kStrip = 20; // height of the row with the phases' names
export const kFoot = 66; // axis and zoom bar

const kTitle_px = 22;

/// Names of series are those of the whole chart: two panels may have a line of the same name.
export const uniqueName = (panel, series) => `${panel.label}|${series.name}`;

/// A legend below the title of a panel, on lines of its own.
export function legendOf(panel, width) {
  const names = panel.series.map((series) => uniqueName(panel, series));
  const shown = panel.series.map((series) => series.name);
  const { option, height } = makeLegend(shown, { left: kLeft - 4, width: width - kLeft - kRight, fontSize: 11 });
  return { height, option: option && { ...option, data: panel.series.map((series, i) => ({ name: names[i], itemStyle: { opacity: series.points ? 1 : 0 } })),
    formatter: (name) => name.split('|').at(-1) } };
}

/// Which panels have a legend. On paper and where there is little room, one that says nothing beyond the one above is left
/// out.
const kNarrow_px = 600;
export function chooseLegends(panels, width) {
  let above = [];
  return panels.map(({ series }) => {
    const names = series.map(({ name }) => name);
    const isSaid = (isOnPaper() || width < kNarrow_px) && names.every((name) => above.includes(name));
    if (!isSaid && names.length > 1) above = names;
    return !isSaid;
  });
}

/// Where the panels lie: [{top, height, legend}], one below the other, each with its title and its legend above it.
const kPanel_px = 108;
export const kFewLabels_px = 70; // height below which an axis has room for few numbers
function headsOf(panels, width) {
  const hasLegend = chooseLegends(panels, width);
  return panels.map((panel, i) => 12 + kTitle_px + (hasLegend[i] ? legendOf(panel, width).height : 0));
}

/// Height of a panel on paper, where many are less high.
const kPaper_px = 860;
const paperHeight = (panels, width) => Math.max(46, Math.min(100, (kPaper_px - headsOf(panels, width).reduce((sum, head) => sum + head, 0)) / panels.length));

export function placePanels({ panels, panel_px = kPanel_px }, width) {
  const heads = headsOf(panels, width);
  const height = panel_px;
  let top = kStrip + 8;
  return panels.map((panel, i) => {
    const place = { top: top + heads[i], height, title: top + 12, legend: top + 12 + kTitle_px - 2 };
    top += heads[i] + height;
    return place;
  });
}
export const panelsBottom = (block, width) => {
  const last = placePanels(block, width).at(-1);
  return last.top + last.height;
};

/// On paper a chart cannot go on behind the end of a sheet: panels in charts of their own, none of which is high.
const kPaperWidth_px = 680; // of style.css
const kPart_px = 380;
export function divideForPaper(block) {
  const panel_px = paperHeight(block.panels, kPaperWidth_px);
  const parts = [];
  let used = Infinity;
  headsOf(block.panels, kPaperWidth_px).forEach((head, i) => {
    if (used + head + panel_px > kPart_px) {
      parts.push([]);
      used = 0;
    }
    parts.at(-1).push(block.panels[i]);
    used += head + panel_px;
  });
  return parts.map((panels) => ({ ...block, panel_px, panels }));
}

/// Limits of an axis that do not blow up what hardly changes. `scale`: what the loaded phases reach; lines may leave the panel
/// beyond.
export function limits({ min, max }, scale) {
  if (scale) {
    const span = scale[1] - scale[0];
    const margin = 0.08 * span;
    const round = 10 ** Math.floor(Math.log10(margin));
    const from = scale[0] >= 0 && scale[0] <= span ? 0 : scale[0] - margin;
    return { min: Math.floor(from / round) * round, max: Math.ceil((scale[1] + margin) / round) * round };
  }
  const least = 0.01 * Math.max(Math.abs(min), Math.abs(max));
  if (max - min >= least || !(least > 0)) return { min: null, max: null };
  const step = 10 ** Math.floor(Math.log10(least));
  return { min: Math.floor((min - least / 2) / step) * step, max: Math.ceil((max + least / 2) / step) * step };
}

const kLabel_px = 17; // from one number of an axis to the next
const kSteps = [1, 2, 5, 10];

/// An axis of a panel that is so low that the numbers would touch: with round steps, no more than there is room for.
export function lowAxis(panel, height) {
  const values = panel.series.flatMap((series) => series.y).filter((y) => y !== null);
  const extent = values.reduce(({ min, max }, y) => ({ min: Math.min(min, y), max: Math.max(max, y) }), { min: Infinity, max: -Infinity });
  const { min, max } = limits(extent, panel.scale);
  const [from, to] = [min ?? extent.min, max ?? extent.max];
  if (!(to > from)) return {};
  const most = Math.max(1, Math.floor(height / kLabel_px));
  const ends = (step) => [Math.floor(from / step + 1e-9), Math.ceil(to / step - 1e-9)];
  const power = 10 ** Math.floor(Math.log10((to - from) / most));
  const step = [1, 10].flatMap((tens) => kSteps.map((k) => k * tens * power)).find((one) => ends(one)[1] - ends(one)[0] <= most) ?? to - from;
  return { min: ends(step)[0] * step, max: ends(step)[1] * step, interval: step };
}
