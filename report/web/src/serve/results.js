// The sections of a result, which stay in place when the next one comes: charts and animation take new data, the rest is
// made again. What is in sight comes first, the rest when the slider rests.
import { chartsIn, forgetChartsIn } from '../chart.js';
import { Clock } from '../clock.js';
import { h } from '../dom.js';
import { kBlocks, makeSection, slug } from '../main.js';

/// Blocks whose element reads its block anew when it is drawn.
const kInPlace = ['times', 'bars', 'curves', 'time_bar'];
/// Blocks that take new data in place for now, and are made again when the slider rests: the scale of their colors may
/// have to change.
const kInPlaceForNow = ['animation', 'cross_section'];

const isObject = (value) => typeof value === 'object' && value !== null;

/// Puts the content of `source` into `target`, in the objects and arrays that are there: others hold them.
function adopt(target, source) {
  if (Array.isArray(target)) target.length = source.length;
  else Object.keys(target).filter((key) => !(key in source)).forEach((key) => delete target[key]);
  for (const key of Object.keys(source)) {
    const [old, next] = [target[key], source[key]];
    if (isObject(old) && isObject(next) && Array.isArray(old) === Array.isArray(next)) adopt(old, next);
    else target[key] = next;
  }
}

/// What has to be the same for a block to stay in place.
function shapeOf(block) {
  if (block.type === 'times') {
    const span = block.panels.map((panel) => [panel.label, panel.unit, panel.series.map((s) => [s.name, s.t[0], s.t.at(-1)])]);
    return [block.title, span, block.view, block.rows, (block.phases || []).map((phase) => phase.name)];
  }
  if (block.type === 'bars' || block.type === 'curves') return [block.label, block.x, block.y, block.series.map((s) => s.name)];
  if (block.type === 'animation') return [block.machine, block.label, block.wheels.length];
  if (block.type === 'cross_section') return [block.surface, block.t.length, block.nodes.map((node) => node.name), block.links.map((link) => [link.from, link.to])];
  return [];
}

/// Whether an element is in sight, without a layout of the page.
const inSight = new WeakSet();
const watchSight = new IntersectionObserver((entries) => entries.forEach((entry) => (entry.isIntersecting ? inSight.add(entry.target) : inSight.delete(entry.target))));

const shapeOfSection = (section) => JSON.stringify([section.folded, section.blocks.map((block) => [block.type, shapeOf(block)])]);
const shapeOfPage = (payload) => JSON.stringify([payload.title, payload.clock && [payload.clock.start_s, payload.clock.end_s], payload.sections.map((section) => section.title)]);

/// The page's clock for one block: its listeners go with the block's element.
class ClockOfBlock {
  constructor(clock) {
    this.clock = clock;
    this.listeners = [];
    clock.onChange(() => this.tell());
  }
  tell() {
    this.listeners.forEach((listener) => listener(this.clock.now_s));
  }
  get start_s() { return this.clock.start_s; }
  get end_s() { return this.clock.end_s; }
  get now_s() { return this.clock.now_s; }
  set(time_s) { this.clock.set(time_s); }
  onChange(listener) {
    this.listeners.push(listener);
    listener(this.clock.now_s);
  }
}

/// Of a chart with panels one above the other those in sight; null of others.
function findPanelsInSight({ block, element }) {
  const chart = block.type === 'times' && element.querySelector('.chart');
  if (!chart) return null;
  const { top, height } = chart.getBoundingClientRect();
  const each = height / block.panels.length;
  return block.panels.map((_, i) => i).filter((i) => top + (i + 1) * each > 0 && top + i * each < innerHeight);
}

const kFirst = ['tiles', 'lead', 'warnings'];

/// What one looks at first: figures with their warnings, then the test over time, then all else. A section that has
/// figures is in two parts: its tables come later.
function sorted(sections) {
  const parts = sections.flatMap((section) => {
    if (!section.blocks.some((block) => block.type === 'tiles')) return [section];
    const blocks = (isFirst) => section.blocks.filter((block) => kFirst.includes(block.type) === isFirst);
    return [{ ...section, blocks: blocks(true) }, { ...section, title: `${section.title} in full`, blocks: blocks(false) }].filter((part) => part.blocks.length);
  });
  const rank = (section) => (section.blocks.some((b) => ['tiles', 'lead'].includes(b.type)) ? 0 : section.blocks.some((b) => b.type === 'times') ? 1 : 2);
  return parts.map((section, i) => ({ section, i })).sort((a, b) => rank(a.section) - rank(b.section) || a.i - b.i).map((one) => one.section);
}

export class Results {
  /// `keepsOrder`: sections as the payload has them.
  constructor({ id = 'content', keepsOrder = false } = {}) {
    this.keepsOrder = keepsOrder;
    this.element = h('main', { id, tabindex: '-1' });
    this.slots = [];
  }

  show(payload) {
    const page = this.keepsOrder ? payload : { ...payload, sections: sorted(payload.sections) };
    const shape = shapeOfPage(page);
    if (shape === this.shape) this.#update(page);
    else this.#rebuild(page);
    this.shape = shape;
  }

  clear() {
    this.#forget();
    this.element.replaceChildren();
    this.shape = null;
  }

  #forget() {
    this.#drop(this.slots);
    this.slots = [];
  }

  #drop(slots) {
    for (const slot of slots) {
      if (slot.clock) slot.clock.listeners = [];
      forgetChartsIn(slot.element);
      watchSight.unobserve(slot.element);
    }
  }

  #rebuild(page) {
    this.#forget();
    const now_s = this.clock && page.clock && this.clock.now_s;
    this.clock = page.clock ? new Clock(page.clock.start_s, page.clock.end_s, page.clock.now_s) : null;
    if (now_s >= page.clock?.start_s && now_s <= page.clock?.end_s) this.clock.now_s = now_s;
    this.sections = page.sections.map((section) => this.#makeSection(section, page));
    this.element.replaceChildren(h('header', null, h('h1', null, page.title), page.subtitle && h('p', { class: 'subtitle' }, page.subtitle)),
      h('nav', { 'aria-label': 'Contents' }, page.sections.map((s) => h('a', { href: `#${slug(s.title)}` }, s.title))), ...this.sections.map((one) => one.element));
    this.slots = this.sections.flatMap((one) => one.slots);
  }

  #makeSection(section, page) {
    const slots = [];
    const make = (block, context) => {
      const slot = { block, clock: this.clock && new ClockOfBlock(this.clock) };
      slot.context = { ...context, clock: slot.clock, section };
      slot.element = kBlocks[block.type](block, slot.context);
      slots.push(slot);
      this.#watchNumbers(slot);
      watchSight.observe(slot.element);
      return slot.element;
    };
    return { shape: shapeOfSection(section), element: makeSection(section, { clock: this.clock, payload: page }, make), slots };
  }

  #update(page) {
    this.element.querySelector('.subtitle')?.replaceChildren(page.subtitle);
    page.sections.forEach((section, i) => {
      const old = this.sections[i];
      if (old.shape === shapeOfSection(section)) section.blocks.forEach((block, n) => this.#take(old.slots[n], block));
      else this.#renew(i, this.#makeSection(section, page));
    });
    this.slots = this.sections.flatMap((one) => one.slots);
    const seen = this.slots.filter((slot) => inSight.has(slot.element));
    seen.forEach((slot) => (slot.panels = findPanelsInSight(slot)));  // before anything changes: else a layout each
    seen.forEach((slot) => this.#refresh(slot));
  }

  /// Everything that show() left for when nothing else is to be done.
  rest() {
    for (const slot of this.slots) {
      slot.isDirty ||= Boolean(slot.panels);
      slot.panels = null;
      this.#refresh(slot);
      if (slot.isRough) this.#remake(slot);
    }
  }

  /// A section of another form, as where there is a warning now.
  #renew(i, next) {
    this.#drop(this.sections[i].slots);
    this.sections[i].element.replaceWith(next.element);
    this.sections[i] = next;
  }

  /// New data, not drawn yet. All blocks have theirs before the first is drawn: an animation reads those of its charts.
  #take(slot, block) {
    slot.isDirty = true;
    if (kInPlace.includes(block.type) || kInPlaceForNow.includes(block.type)) adopt(slot.block, block);
    else slot.block = block;
  }

  #refresh(slot) {
    if (!slot.isDirty) return;
    slot.isDirty = false;
    if (kInPlace.includes(slot.block.type)) {
      const { panels } = slot;
      chartsIn(slot.element).forEach((chart) => chart.refresh(panels && ((series) => panels.includes(series.yAxisIndex - 1))));
      slot.isStale = true;
      if (slot.element.querySelector('details.numbers')?.open) this.#renewNumbers(slot);
    } else if (kInPlaceForNow.includes(slot.block.type)) {
      slot.isRough = true;
      slot.clock?.tell();
    } else {
      this.#remake(slot);
    }
  }

  #remake(slot) {
    slot.isRough = false;
    if (slot.clock) slot.clock.listeners = [];
    this.#replace(slot, kBlocks[slot.block.type](slot.block, slot.context));
  }

  #replace(slot, element) {
    const open = [...slot.element.querySelectorAll('details')].map((one) => one.open);
    const drawn = chartsIn(slot.element).some((chart) => chart.instance);
    forgetChartsIn(slot.element);
    watchSight.unobserve(slot.element);
    slot.element.replaceWith(element);
    if (inSight.has(slot.element)) inSight.add(element);
    slot.element = element;
    watchSight.observe(element);
    [...element.querySelectorAll('details')].forEach((one, i) => (one.open = Boolean(open[i])));
    if (drawn) chartsIn(element).forEach((chart) => chart.draw());
  }

  /// The numbers of a chart as a table are made again when they are looked at.
  #watchNumbers(slot) {
    const numbers = kInPlace.includes(slot.block.type) && slot.element.querySelector('details.numbers');
    if (numbers) numbers.addEventListener('toggle', () => numbers.open && slot.isStale && this.#renewNumbers(slot));
  }

  #renewNumbers(slot) {
    slot.isStale = false;
    const element = kBlocks[slot.block.type](slot.block, { ...slot.context, clock: null });
    const [old, made] = [slot.element, element].map((one) => one.querySelector('details.numbers'));
    forgetChartsIn(element);
    old.replaceChildren(...made.childNodes);
  }
}
