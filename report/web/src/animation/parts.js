// Parts of rigs and vehicles in meters, y downwards as SVG has it.
import { h, set, svg } from '../dom.js';
import { color } from '../theme.js';

/// Cold to hot: dark blue, green, yellow, red; lighter as it warms, so that it reads in black and white.
const kHeat = [[59, 76, 192], [68, 132, 181], [94, 176, 142], [188, 196, 96], [240, 160, 60], [214, 66, 48]];

export function heatColor(share) {
  const at = Math.min(0.9999, Math.max(0, share)) * (kHeat.length - 1);
  const i = Math.floor(at);
  const mix = kHeat[i].map((c, k) => Math.round(c + (at - i) * (kHeat[i + 1][k] - c)));
  return `rgb(${mix.join(',')})`;
}

const degrees = (rad) => ((rad * 180) / Math.PI) % 360;
export const rotate = (element, rad, x = 0, y = 0) => element.setAttribute('transform', `translate(${x} ${y}) rotate(${degrees(rad)})`);

const polar = (r, a) => [r * Math.cos(a), r * Math.sin(a)];

function spokes(count, inner, outer, attributes) {
  return Array.from({ length: count }, (_, i) => {
    const a = (2 * Math.PI * i) / count;
    const [x1, y1] = polar(inner, a);
    const [x2, y2] = polar(outer, a);
    return svg('line', { x1, y1, x2, y2, ...attributes });
  });
}

/// A drum or roller about the origin, with one spoke marked so that its turning is seen.
export function makeDrum(radius) {
  const turning = svg('g', null,
    svg('circle', { r: radius, class: 'steel' }),
    svg('circle', { r: 0.93 * radius, class: 'line' }),
    spokes(6, 0.14 * radius, 0.93 * radius, { class: 'line' }),
    svg('line', { x1: 0.14 * radius, y1: 0, x2: 0.93 * radius, y2: 0, class: 'mark' }),
    svg('circle', { r: 0.14 * radius, class: 'hub' }));
  return { element: turning, turn: (rad, x, y) => rotate(turning, rad, x, y) };
}

/// A wheel with its tire about the origin.
export function makeWheel(tire) {
  const rubber = svg('circle', { r: (tire.radius_m + tire.rim_radius_m) / 2, fill: 'none', 'stroke-width': tire.radius_m - tire.rim_radius_m });
  const turning = svg('g', null, rubber,
    spokes(36, tire.radius_m - 0.022, tire.radius_m, { class: 'tread' }),
    svg('circle', { r: tire.radius_m, class: 'line' }),
    svg('circle', { r: tire.rim_radius_m, class: 'rim' }),
    spokes(5, 0.2 * tire.rim_radius_m, 0.92 * tire.rim_radius_m, { class: 'spoke' }),
    svg('line', { x1: 0.2 * tire.rim_radius_m, y1: 0, x2: 0.92 * tire.rim_radius_m, y2: 0, class: 'mark' }),
    svg('circle', { r: 0.2 * tire.rim_radius_m, class: 'hub' }));
  return {
    element: turning,
    turn: (rad, x, y) => rotate(turning, rad, x, y),
    heat: (share) => rubber.setAttribute('stroke', heatColor(share)),
  };
}

/// An arrow whose length follows a force: from (x, y) along (dx, dy), with a label at its tail.
export function makeArrow(name) {
  const line = svg('line', { class: 'force' });
  const head = svg('path', { class: 'head' });
  const text = svg('text', { class: 'label' }, name);
  const element = svg('g', null, line, head, text);
  return {
    element,
    point(x, y, dx, dy, label, anchor = 'start', below = 0.06) {
      const length = Math.hypot(dx, dy);
      text.textContent = label;
      set(text, { x: x + (anchor === 'start' ? 0.05 : -0.05), y: y + below, 'text-anchor': anchor });
      line.style.display = head.style.display = length < 1e-3 ? 'none' : '';
      if (length < 1e-3) return;
      const [ux, uy] = [dx / length, dy / length];
      const s = 0.05;
      const [bx, by] = [x + dx - s * ux, y + dy - s * uy];
      set(line, { x1: x, y1: y, x2: bx, y2: by });
      set(head, { d: `M${x + dx} ${y + dy}L${bx - 0.6 * s * uy} ${by + 0.6 * s * ux}L${bx + 0.6 * s * uy} ${by - 0.6 * s * ux}Z` });
    },
  };
}

/// The scale of the tire's color, along the left edge.
export function makeHeatScale({ x, y, width, height, low, high }) {
  const bands = Array.from({ length: 24 }, (_, i) => svg('rect', { x, y: y + (height * i) / 24, width, height: height / 24 + 0.002, fill: heatColor(1 - (i + 0.5) / 24) }));
  const pointer = svg('path', { class: 'pointer' });
  const text = (value, at) => svg('text', { x: x + width / 2, y: at, class: 'label small', 'text-anchor': 'middle' }, `${Math.round(value)} \u00b0C`);
  return {
    element: svg('g', null, bands, svg('rect', { x, y, width, height, class: 'frame' }), text(high, y - 0.03), text(low, y + height + 0.075), pointer),
    point(share) {
      const at = y + height * (1 - Math.min(1, Math.max(0, share)));
      set(pointer, { d: `M${x + width + 0.01} ${at}l0.05 -0.03v0.06z` });
    },
  };
}
