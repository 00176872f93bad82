// The test rig as it moves, drawn from the recorded poses; the tire is colored by its temperature.
//
// {machine: drum | belt | rollers | road, label, caption, wheels: [{tire, ...}], body, temperature_degC: [low, high], ...}
// Series are {t, y}. Beside it stands what the channels of the section's time chart show at that time.
import { h, svg } from '../dom.js';
import { decimalsFor, fixed } from '../format.js';
import { valueAt } from '../clock.js';
import { makeScene } from './scene.js';

/// The channels of the time chart; of panels with a line a wheel the first wheel alone.
function findReadings(section) {
  const times = section.blocks.find((block) => block.type === 'times');
  return times.panels.flatMap((panel) => {
    const isByWheel = panel.series.some((s) => / (left|right)( outer| inner)?$/.test(s.name));
    const name = (s) => (isByWheel ? `${panel.label}, ${s.name}` : s.name);
    return (isByWheel ? panel.series.slice(0, 1) : panel.series).map((s) => ({ name: name(s), unit: panel.unit, t: s.t, y: s.y }));
  });
}

/// Every channel's value at the page's time.
function makeReadings(readings, clock) {
  const cells = readings.map(({ name, unit }) => {
    const value = h('td', { class: 'right' });
    return { value, row: h('tr', null, h('th', { scope: 'row' }, name), value, h('td', { class: 'unit' }, unit)) };
  });
  const decimals = readings.map(({ y }) => decimalsFor(...y.reduce((r, v) => (v === null ? r : [Math.min(r[0], v), Math.max(r[1], v)]), [Infinity, -Infinity])));
  clock.onChange((t) => readings.forEach((reading, i) => {
    const now = valueAt(reading, t);
    cells[i].value.textContent = now === null ? '\u2013' : fixed(now, decimals[i]);
  }));
  return h('table', { class: 'lines readings' }, h('caption', null, 'Now'), h('tbody', null, cells.map((cell) => cell.row)));
}

export function animationBlock(block, { clock, section }) {
  const scene = makeScene(block);
  const picture = svg('svg', { viewBox: scene.viewBox.join(' '), class: 'animation', role: 'img', 'aria-label': block.label }, scene.element);
  clock.onChange((t) => scene.show(t));
  return h('div', { class: 'stage' },
    h('figure', { class: 'animationfigure' }, picture, h('figcaption', null, block.caption)),
    makeReadings(findReadings(section), clock));
}
