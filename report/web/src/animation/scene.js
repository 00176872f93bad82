// Scenes of the machines. Lengths in meters; each scene has an element and show(time_s). `recorded` gives the value of a
// recorded row at a time.
import { svg } from '../dom.js';
import { fixed } from '../format.js';
import { valueAt } from '../clock.js';
import { makeArrow, makeDrum, makeHeatScale, makeWheel } from './parts.js';

const kNewtonsPerMeter = 14000; // of the arrows

function makeHeat(block) {
  const [low, high] = block.temperature_degC;
  return (value) => (high > low ? (value - low) / (high - low) : 0.5);
}

/// A belt over two drums of radius r, its upper side at height 0.
function makeBelt(r) {
  const half = 2.2 * r;
  const drums = [-half, half].map((x) => ({ x, drawn: makeDrum(r) }));
  const loop = svg('rect', { x: -half - r, y: 0, width: 2 * (half + r), height: 2 * r, rx: r, class: 'belt' });
  return {
    element: svg('g', null, drums.map((d) => d.drawn.element), loop),
    turn: (angle_rad) => drums.forEach((d) => d.drawn.turn(angle_rad, d.x, r)),
  };
}

/// The drum, or the belt, with the carriage that presses the wheel on it from above.
function makeDrumScene(block, recorded) {
  const [wheel] = block.wheels;
  const { tire } = wheel;
  const isBelt = block.machine === 'belt';
  const R = isBelt ? 0 : block.drum_radius_m;
  const below = isBelt ? 2 * block.drum_radius_m + 0.02 : 0.5;  // of what is drawn under the tire
  const highest = R + 2 * tire.radius_m + 0.62;
  const width = (isBelt ? 6.4 : 2) * block.drum_radius_m + 1.1;
  const share = makeHeat(block);
  const drum = isBelt ? makeBelt(block.drum_radius_m) : makeDrum(R);
  const turning = makeWheel(tire);
  const scale = makeHeatScale({ x: -width / 2 + 0.14, y: -highest + 0.18, width: 0.09, height: 0.72, low: block.temperature_degC[0], high: block.temperature_degC[1] });
  const load = makeArrow();
  const speed = makeArrow();
  const rail = svg('g', null, [-0.2, 0.2].map((x) => svg('line', { x1: x, x2: x, y1: -highest + 0.06, y2: -R - tire.radius_m + 0.02, class: 'rail' })),
    svg('line', { x1: -0.3, x2: 0.3, y1: -highest + 0.06, y2: -highest + 0.06, class: 'rail' }));
  const carriage = svg('g', null, svg('rect', { x: -0.24, y: -0.52, width: 0.48, height: 0.15, rx: 0.02, class: 'block' }),
    svg('rect', { x: -0.045, y: -0.4, width: 0.09, height: 0.44, class: 'block' }), svg('circle', { r: 0.06, class: 'hub' }));
  return {
    viewBox: [-width / 2, -highest - 0.02, width, highest + below + 0.08],
    element: svg('g', null, svg('clipPath', { id: 'below' }, svg('rect', { x: -width, y: -highest, width: 2 * width, height: highest + below })),
      rail, turning.element, svg('g', { 'clip-path': 'url(#below)' }, drum.element), carriage, load.element, speed.element, scale.element),
    show(t) {
      const height = valueAt(wheel.axle_height_m, t);
      const now_N = recorded(wheel.load_N, t);
      const km_h = recorded(block.speed_km_h, t);
      const heat = share(valueAt(wheel.temperature_degC, t));
      drum.turn(-valueAt(wheel.surface_angle_rad, t), 0, 0);
      turning.turn(valueAt(wheel.angle_rad, t), 0, -height);
      turning.heat(heat);
      scale.point(heat);
      carriage.setAttribute('transform', `translate(0 ${-height})`);
      load.point(0.36, -height - 0.55, 0, Math.max(0, now_N) / kNewtonsPerMeter, `load ${fixed(now_N, 0)} N`);
      speed.point(isBelt ? 0.8 : R * 0.5, 0.3, -Math.min(0.8, km_h / 160), 0, `${fixed(km_h, 1)} km/h`, 'start');
    },
  };
}

/// A plain saloon about its center of gravity; on more than two axles a tractor's cab and frame.
function makeShell({ axles_x_m, height_m }) {
  const front_x_m = Math.max(...axles_x_m);
  const a = (front_x_m - Math.min(...axles_x_m)) / 2;
  const at = (x, y) => `${(front_x_m - a + x).toFixed(3)} ${(height_m - y).toFixed(3)}`;
  if (axles_x_m.length > 2) {
    return svg('path', { class: 'shell', d: `M${at(-a - 0.8, 0.8)} L${at(-a - 0.8, 1.1)} L${at(a - 1.0, 1.1)} L${at(a - 1.0, 3.2)} L${at(a + 1.1, 3.2)} `
      + `L${at(a + 1.25, 1.9)} L${at(a + 1.25, 0.5)} L${at(a + 0.6, 0.5)} L${at(a - 1.0, 0.8)} Z` });
  }
  return svg('path', { class: 'shell', d: `M${at(-a - 0.85, 0.24)} L${at(-a - 0.9, 0.62)} Q${at(-a - 0.85, 0.9)} ${at(-a - 0.5, 0.95)} L${at(-a - 0.1, 0.98)} `
    + `Q${at(-0.75, 1.45)} ${at(-0.2, 1.47)} L${at(0.35, 1.47)} Q${at(0.75, 1.43)} ${at(a - 0.3, 0.97)} Q${at(a + 0.55, 0.9)} ${at(a + 0.78, 0.7)} L${at(a + 0.82, 0.24)} Z` });
}

/// The share of the body that one wheel carries, on its spring.
const makeQuarter = ({ height_m }) => svg('g', null,
  svg('rect', { x: -0.34, y: height_m - 1.12, width: 0.68, height: 0.2, rx: 0.03, class: 'block' }),
  svg('line', { x1: 0, y1: height_m - 0.92, x2: 0, y2: height_m - 0.4, class: 'rail' }));

/// A vehicle, or one wheel with its share of it, on rollers or on the road.
function makeVehicleScene(block, recorded) {
  const { body } = block;
  const isWhole = body.axles_x_m.length > 0;
  const R = block.drum_radius_m || 0;
  const share = makeHeat(block);
  const xs = isWhole ? body.axles_x_m : [0];
  const left = Math.min(...xs) - (isWhole ? 1.5 : 1.15);
  const right = Math.max(...xs) + (isWhole ? 1.25 : 1.15);
  const top = xs.length > 2 ? 3.4 : isWhole ? 1.78 : 1.32;
  const depth = block.machine === 'road' ? 0.28 : isWhole ? 0.6 : 0.75;
  const scale = makeHeatScale({ x: left + 0.14, y: -top + 0.2, width: 0.09, height: 0.6, low: block.temperature_degC[0], high: block.temperature_degC[1] });
  const wheels = block.wheels.map((wheel) => ({ ...wheel, drawn: makeWheel(wheel.tire), roller: block.machine === 'rollers' ? makeDrum(R) : null, force: makeArrow() }));
  const shell = svg('g', null, isWhole ? makeShell(body) : makeQuarter(body));
  const ticks = svg('g', { class: 'road' });
  const ground = block.machine === 'road'
    ? [svg('rect', { x: left, y: 0, width: right - left, height: depth, class: 'ground' }), ticks]
    : [svg('line', { x1: left, x2: right, y1: 0.01, y2: 0.01, class: 'floor' })];
  const speed = makeArrow();
  return {
    viewBox: [left, -top, right - left, top + depth],
    element: svg('g', null, shell, wheels.map((w) => w.drawn.element), ground, wheels.map((w) => w.roller && w.roller.element), wheels.map((w) => w.force.element), speed.element, scale.element),
    show(t) {
      const km_h = recorded(block.speed_km_h, t);
      for (const wheel of wheels) {
        const heat = share(valueAt(wheel.temperature_degC, t));
        wheel.drawn.turn(valueAt(wheel.angle_rad, t), wheel.x_m, -valueAt(wheel.axle_height_m, t));
        wheel.drawn.heat(heat);
        if (wheel === wheels[0]) scale.point(heat);
        if (wheel.roller) wheel.roller.turn(-valueAt(wheel.surface_angle_rad, t), wheel.x_m, R);
        const force_N = valueAt(wheel.force_N, t);
        const length = Math.sign(force_N) * Math.min(0.7, Math.abs(force_N) / 1500);
        wheel.force.point(wheel.x_m, -0.03, length, 0, '');
      }
      const pitch_deg = body.pitch_rad ? (valueAt(body.pitch_rad, t) * 180) / Math.PI : 0;
      shell.setAttribute('transform', `translate(0 ${-(body.height_m + valueAt(body.heave_m, t))}) rotate(${-pitch_deg})`);
      if (block.machine === 'road') moveRoad(ticks, valueAt(block.position_m, t), left, right);
      speed.point(right - 0.64, -top + 0.13, Math.min(0.58, km_h / 240), 0, `${fixed(km_h, 1)} km/h`, 'start', 0.14);
    },
  };
}

function moveRoad(ticks, position_m, left, right) {
  const gap = 0.6;
  const first = -((position_m % gap) + gap) % gap;
  const marks = [];
  for (let x = left + ((first - left) % gap); x < right; x += gap) if (x > left) marks.push(svg('line', { x1: x, x2: x - 0.08, y1: 0.02, y2: 0.16 }));
  ticks.replaceChildren(...marks);
}

export const makeScene = (block, recorded) => (block.machine === 'drum' || block.machine === 'belt' ? makeDrumScene(block, recorded) : makeVehicleScene(block, recorded));
