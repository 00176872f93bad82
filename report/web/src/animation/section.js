// Section through the tire over its contact, colored by the temperatures of the model's nodes, with the heat flows as
// arrows. Of the run's data nothing is computed but the value at a time.
//
// {title, label, caption, surface: drum | belt | roller | road, width_m, radius_m, rim_radius_m, range_degC: [low, high],
//  t: ends of stretches, nodes: [{node: liner | gas | tread | rim | further, name, degC: at the ends}],
//  generated_W, to_air_W, to_surface_W, stored_W: means over the stretches, links: [{from, to, W}]}
import { rowAt, valueAt } from '../clock.js';
import { h, set, svg } from '../dom.js';
import { clockTime, fixed } from '../format.js';
import { drawSvg } from '../picture.js';
import { column, saveMenu } from '../save.js';
import { heatColor } from './parts.js';

const kView = { width: 620, height: 372 };
const kContact = 296; // y of the surface
const kTallest = 222; // of the tire between rim and surface, px
const kWidestTire = 300;
const kAbove = 74; // of what is drawn over the rim's seat
const kMiddle = 310;
const kWidest = 30; // of an arrow
const kTip = 13;

/// An arrow of a heat flow along a line; it points back where the flow is negative.
function makeFlow({ from, to, label, at, anchor = 'middle' }) {
  const body = svg('path', { class: 'flow' });
  const text = svg('text', { x: at[0], y: at[1], 'text-anchor': anchor, class: 'flowlabel' });
  const name = svg('tspan', null, label);
  const value = svg('tspan', { x: at[0], dy: '1.15em', class: 'flowvalue' });
  text.append(name, value);
  return {
    element: svg('g', null, body, text),
    show(power_W, largest_W) {
      value.textContent = `${fixed(power_W, 0)} W`;
      const width = (kWidest * Math.abs(power_W)) / largest_W;
      body.style.display = width < 0.3 ? 'none' : '';
      const [[x0, y0], [x1, y1]] = power_W >= 0 ? [from, to] : [to, from];
      const length = Math.hypot(x1 - x0, y1 - y0);
      const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
      const half = Math.max(0.75, width / 2);
      const wing = half + 5;
      const point = (along, across) => `${(x0 + along * ux - across * uy).toFixed(1)} ${(y0 + along * uy + across * ux).toFixed(1)}`;
      const neck = length - kTip;
      set(body, { d: `M${point(0, half)}L${point(neck, half)}L${point(neck, wing)}L${point(length, 0)}L${point(neck, -wing)}L${point(neck, -half)}L${point(0, -half)}Z` });
    },
  };
}

/// Outlines of the section, of half width w and so high, px: the outside, the cavity, and what lies between them.
function makeOutlines(w, height) {
  const x = (share) => [kMiddle - share * w, kMiddle + share * w];
  const rim = kContact - height; // y of its seat
  const y = (share) => rim + share * height;
  const loop = ([bead, belly, shoulder, crown], [yBelly, yShoulder, yCrown]) => {
    const [bl, br] = x(bead), [gl, gr] = x(belly), [sl, sr] = x(shoulder), [cl, cr] = x(crown);
    return `M${bl} ${rim}C${gl} ${y(yBelly * 0.45)} ${gl} ${y(yBelly * 1.35)} ${sl} ${y(yShoulder)}Q${(sl + cl) / 2 - 4} ${y(yCrown)} ${cl} ${y(yCrown)}`
      + `L${cr} ${y(yCrown)}Q${(sr + cr) / 2 + 4} ${y(yCrown)} ${sr} ${y(yShoulder)}C${gr} ${y(yBelly * 1.35)} ${gr} ${y(yBelly * 0.45)} ${br} ${rim}Z`;
  };
  return {
    outside: loop([0.8, 1.14, 0.9, 0.78], [0.5, 0.88, 1]),
    cavity: loop([0.7, 1.0, 0.8, 0.68], [0.46, 0.76, 0.84]),
    belt: `M${x(0.8)[0]} ${y(0.905)}Q${kMiddle} ${y(0.925)} ${x(0.8)[1]} ${y(0.905)}`,
    tread: { x: x(1)[0] - 20, y: y(0.87), width: 2 * w + 40, height: height * 0.13 + 1 },
    rim,
    y,
    x,
  };
}

/// Grooves of the tread, on the surface.
const makeGrooves = ({ x, y }) => [-0.45, -0.15, 0.15, 0.45].map((share) => svg('rect', { x: kMiddle + share * (x(1)[1] - kMiddle) - 3, y: y(0.945), width: 6, height: kContact - y(0.945) + 1, class: 'groove' }));

/// What lies below: a drum or roller has an edge to both sides, a road goes on.
function makeSurface(kind, w) {
  const wide = kind === 'road' ? kView.width : Math.min(kView.width - 20, 2 * w + 150);
  const left = kMiddle - wide / 2;
  return svg('g', null, svg('rect', { x: left, y: kContact, width: wide, height: kView.height - kContact, class: 'ground' }),
    svg('line', { x1: left, x2: left + wide, y1: kContact, y2: kContact, class: 'edge' }));
}

function makeScale([low, high], top) {
  const [x, y, width, height] = [8, top + 26, 13, 104];
  const bands = Array.from({ length: 30 }, (_, i) => svg('rect', { x, y: y + (height * i) / 30, width, height: height / 30 + 0.4, fill: heatColor(1 - (i + 0.5) / 30) }));
  return svg('g', null, bands, svg('rect', { x, y, width, height, class: 'frame' }),
    svg('text', { x, y: y - 8, class: 'scalelabel' }, `${high} \u00b0C`), svg('text', { x, y: y + height + 18, class: 'scalelabel' }, `${low} \u00b0C`));
}

/// Where the arrows of links run. A link that is not listed stands in the table alone.
function placeLinks(outlines, hasTread) {
  const { rim, x, y } = outlines;
  const inside = y(0.845);
  return {
    'liner tread': { label: 'carcass to tread', from: [x(0.925)[0], y(0.54)], to: [x(0.87)[0], y(0.93)], at: [x(0.74)[0], y(0.62)], anchor: 'start' },
    'liner gas': { label: 'to gas', from: [x(hasTread ? 0.32 : 0)[1], inside], to: [x(hasTread ? 0.32 : 0)[1], y(0.52)], at: [x(hasTread ? 0.32 : 0)[1], y(0.26)] },
    'gas rim': { label: 'gas to rim', from: [kMiddle, y(0.2)], to: [kMiddle, rim - 20], at: [kMiddle, rim - 50] },
    'liner rim': { label: 'carcass to rim', from: [x(0.78)[0], y(0.12)], to: [x(0.62)[0], rim - 26], at: [x(0.78)[0] - 12, rim - 46] },
  };
}

/// A row for each end of a stretch; the flows of a row are means over the stretch that begins there.
const makeSectionData = (block, links) => [column('time', 's', block.t), ...block.nodes.map(({ name, degC }) => column(name, '\u00b0C', degC)),
  column('loss', 'W', block.generated_W), column('to air', 'W', block.to_air_W), column(`to ${block.surface}`, 'W', block.to_surface_W), column('stored', 'W', block.stored_W),
  ...links.map(({ name, W }) => column(name, 'W', W))];

export function crossSectionBlock(block, { clock }) {
  const height_m = block.radius_m - block.rim_radius_m;
  const scale = Math.min(kTallest / height_m, kWidestTire / block.width_m); // px a meter
  const w = 0.5 * block.width_m * scale;
  const outlines = makeOutlines(w, height_m * scale);
  const top = outlines.rim - kAbove;
  const { rim } = outlines;
  const nodes = Object.fromEntries(block.nodes.map((node) => [node.node, node]));
  const parts = {
    tread: [svg('path', { d: outlines.outside, 'clip-path': 'url(#treadarea)' })],
    liner: [svg('path', { d: outlines.outside }), svg('path', { d: outlines.cavity, class: 'liner' })],
    gas: [svg('path', { d: outlines.cavity })],
    rim: [svg('path', { class: 'wheelrim', d: `M${outlines.x(0.8)[0] - 10} ${rim - 14}L${outlines.x(0.8)[0] - 10} ${rim + 3}L${outlines.x(0.68)[0]} ${rim + 3}L${outlines.x(0.5)[0]} ${rim + 16}L${outlines.x(0.5)[1]} ${rim + 16}`
      + `L${outlines.x(0.68)[1]} ${rim + 3}L${outlines.x(0.8)[1] + 10} ${rim + 3}L${outlines.x(0.8)[1] + 10} ${rim - 14}L${outlines.x(0.4)[1]} ${rim - 14}L${outlines.x(0.32)[1]} ${rim - 2}L${outlines.x(0.32)[0]} ${rim - 2}L${outlines.x(0.4)[0]} ${rim - 14}Z` })],
  };
  const all = [block.generated_W, block.to_air_W, block.to_surface_W, ...block.links.map((link) => link.W)];
  const largest_W = Math.max(1, ...all.flat().map(Math.abs));
  const [left, right] = outlines.x(1.14);
  const flows = [
    { values: block.generated_W, drawn: makeFlow({ label: 'loss', from: [left - 96, outlines.y(0.92)], to: [outlines.x(0.78)[0], outlines.y(0.92)], at: [left - 96, outlines.y(0.92) - 42], anchor: 'start' }) },
    { values: block.to_air_W, drawn: makeFlow({ label: 'to air', from: [right - 18, outlines.y(0.5)], to: [right + 78, outlines.y(0.4)], at: [right + 14, outlines.y(0.2)], anchor: 'start' }) },
    { values: block.to_surface_W, drawn: makeFlow({ label: `to ${block.surface}`, from: [kMiddle, outlines.y(0.965)], to: [kMiddle, kContact + 56], at: [kMiddle + 34, kContact + 34], anchor: 'start' }) },
  ];
  const links = block.links.map(({ from, to, W }) => ({ name: `${nodes[from]?.name ?? from} to ${nodes[to]?.name ?? to}`, W }));
  const places = placeLinks(outlines, Boolean(nodes.tread));
  const further = [];
  block.links.forEach((link, i) => {
    const place = places[`${link.from} ${link.to}`];
    if (place) flows.push({ values: link.W, drawn: makeFlow(place) });
    else further.push({ name: links[i].name, values: link.W });
  });
  const picture = svg('svg', { viewBox: `0 ${top} ${kView.width} ${kView.height - top}`, class: 'crosssection', role: 'img', 'aria-label': block.label },
    svg('clipPath', { id: 'treadarea' }, svg('rect', outlines.tread)), makeSurface(block.surface, w),
    parts.liner[0], parts.tread, svg('path', { d: outlines.belt, class: 'belt' }), makeGrooves(outlines), parts.gas, parts.liner[1], parts.rim,
    svg('path', { d: outlines.outside, class: 'outline' }), makeScale(block.range_degC, top), flows.map((flow) => flow.drawn.element));
  const caption = h('caption');
  const row = (name, unit) => {
    const value = h('td', { class: 'right' });
    return { value, element: h('tr', null, h('th', { scope: 'row' }, name), value, h('td', { class: 'unit' }, unit)) };
  };
  const temperatures = block.nodes.map((node) => row(node.name, '\u00b0C'));
  const stored = row('stored', 'W');
  const others = further.map((flow) => row(flow.name, 'W'));
  const [low, high] = block.range_degC;
  const share = (degC) => (high > low ? (degC - low) / (high - low) : 0.5);
  const paint = (names, degC) => names.forEach((part) => (parts[part] || []).forEach((shape) => set(shape, { fill: heatColor(share(degC)) })));
  clock.onChange((t) => {
    const stretch = Math.min(rowAt(block.t, t), block.generated_W.length - 1);
    const degC = block.nodes.map((node) => valueAt({ t: block.t, y: node.degC }, t));
    block.nodes.forEach((node, i) => {
      temperatures[i].value.textContent = fixed(degC[i], 1);
      paint(node.node === 'liner' && !nodes.tread ? ['liner', 'tread'] : [node.node], degC[i]);
    });
    flows.forEach((flow) => flow.drawn.show(flow.values[stretch], largest_W));
    others.forEach((one, i) => (one.value.textContent = fixed(further[i].values[stretch], 0)));
    stored.value.textContent = fixed(block.stored_W[stretch], 0);
    caption.textContent = `Flows from ${clockTime(block.t[stretch])} to ${clockTime(block.t[stretch + 1])}`;
  });
  const saved = { title: block.title, data: () => makeSectionData(block, links), picture: () => drawSvg(picture) };
  return h('figure', { class: 'heat' }, h('h3', null, block.title),
    h('div', { class: 'stage' }, picture,
      h('table', { class: 'lines heatvalues' }, caption, h('tbody', null, temperatures.map((r) => r.element), stored.element, others.map((r) => r.element)))),
    h('figcaption', null, block.caption), h('div', { class: 'chartfoot' }, saveMenu(saved)));
}
