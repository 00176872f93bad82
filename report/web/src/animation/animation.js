// The test rig as it moves, drawn from the recorded poses; the tire is colored by its temperature.
//
// {machine: drum | belt | rollers | road, label, caption, wheels: [{tire, ...}], body, temperature_degC: [low, high], ...}
// Series are {t, y}; loads and speeds, which the picture says in numbers, are recorded rows {row, y}. Beside it stand the
// values of the recording's last row at or before that time.
import { h, svg } from '../dom.js';
import { clockTime, decimalsFor, fixed } from '../format.js';
import { recordedAt, rowAt, rowTimes } from '../clock.js';
import { makeScene } from './scene.js';

/// The channels of the time chart that are read; of panels with a line a wheel the first wheel alone.
function findReadings(times) {
  return times.panels.flatMap((panel) => {
    const isByWheel = panel.series.some((s) => !s.recorded);
    const name = (s) => (isByWheel ? `${panel.label}, ${s.name}` : s.name);
    return panel.series.filter((s) => s.recorded).map((s) => ({ name: name(s), unit: panel.unit, ...s.recorded }));
  });
}

/// Every channel's value in the row of the page's time.
function makeReadings(readings, times_s, clock) {
  const caption = h('caption');
  const cells = readings.map(({ name, unit }) => {
    const value = h('td', { class: 'right' });
    return { value, row: h('tr', null, h('th', { scope: 'row' }, name), value, h('td', { class: 'unit' }, unit)) };
  });
  const decimals = readings.map(({ y }) => decimalsFor(...y.reduce((r, v) => (v === null ? r : [Math.min(r[0], v), Math.max(r[1], v)]), [Infinity, -Infinity])));
  clock.onChange((t) => {
    const row = rowAt(times_s, t);
    caption.textContent = `Recorded at ${clockTime(times_s[row])}`;
    readings.forEach((reading, i) => {
      const now = recordedAt(reading, row, times_s);
      cells[i].value.textContent = now === null ? '\u2013' : fixed(now, decimals[i]);
    });
  });
  return h('table', { class: 'lines readings' }, caption, h('tbody', null, cells.map((cell) => cell.row)));
}

export function animationBlock(block, { clock, section }) {
  const times = section.blocks.find((one) => one.type === 'times');
  const times_s = rowTimes(times.rows);
  const scene = makeScene(block, (series, t) => recordedAt(series, rowAt(times_s, t), times_s));
  const picture = svg('svg', { viewBox: scene.viewBox.join(' '), class: 'animation', role: 'img', 'aria-label': block.label }, scene.element);
  clock.onChange((t) => scene.show(t));
  return h('div', { class: 'stage' },
    h('figure', { class: 'animationfigure' }, picture, h('figcaption', null, block.caption)),
    makeReadings(findReadings(times), times_s, clock));
}
