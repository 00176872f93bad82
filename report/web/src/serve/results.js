// The sections of a result, which stay in place when the next one comes: charts take new data, the rest is made anew.
// What is in sight comes first.
import { chartsIn, forgetChartsIn } from '../chart.js';
import { Clock } from '../clock.js';
import { h } from '../dom.js';
import { kBlocks, makeSection, slug } from '../main.js';

/// Blocks whose element reads its block anew when it is drawn.
const kInPlace = ['times', 'bars', 'curves', 'time_bar'];

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
    return [block.title, span, block.view, (block.phases || []).map((phase) => phase.name)];
  }
  if (block.type === 'bars' || block.type === 'curves') return [block.label, block.x, block.y, block.series.map((s) => s.name)];
  return [];
}

const shapeOfPage = (payload) => JSON.stringify([payload.title, payload.clock && [payload.clock.start_s, payload.clock.end_s],
  payload.sections.map((section) => [section.title, section.folded, section.blocks.map((block) => [block.type, shapeOf(block)])])]);

/// The page's clock for one block: its listeners go with the block's element.
class ClockOfBlock {
  constructor(clock) {
    this.clock = clock;
    this.listeners = [];
    clock.onChange((time_s) => this.listeners.forEach((listener) => listener(time_s)));
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

const isInSight = (element) => {
  const box = element.getBoundingClientRect();
  return box.height > 0 && box.bottom > 0 && box.top < innerHeight;
};

/// What one looks at first: figures, then the test over time, then all else.
function sorted(sections) {
  const rank = (section) => (section.blocks.some((b) => ['tiles', 'lead', 'warnings'].includes(b.type)) ? 0 : section.blocks.some((b) => b.type === 'times') ? 1 : 2);
  return sections.map((section, i) => ({ section, i })).sort((a, b) => rank(a.section) - rank(b.section) || a.i - b.i).map((one) => one.section);
}

export class Results {
  /// `keepsOrder`: sections as the payload has them.
  constructor({ keepsOrder = false } = {}) {
    this.keepsOrder = keepsOrder;
    this.element = h('main', { id: 'content', tabindex: '-1' });
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
    clearTimeout(this.later);
    this.slots.forEach((slot) => forgetChartsIn(slot.element));
    this.slots = [];
  }

  #rebuild(page) {
    this.#forget();
    const now_s = this.clock && page.clock && this.clock.now_s;
    this.clock = page.clock ? new Clock(page.clock.start_s, page.clock.end_s, page.clock.now_s) : null;
    if (now_s >= page.clock?.start_s && now_s <= page.clock?.end_s) this.clock.now_s = now_s;
    const blocks = page.sections.map((section) => section.blocks.map((block) => ({ block, clock: this.clock && new ClockOfBlock(this.clock) })));
    const elements = page.sections.map((section, i) => {
      let n = 0;
      const make = (block, context) => {
        const slot = blocks[i][n++];
        slot.context = { ...context, clock: slot.clock, section };
        slot.element = kBlocks[block.type](block, slot.context);
        return slot.element;
      };
      return makeSection(section, { clock: this.clock, payload: page }, make);
    });
    this.element.replaceChildren(h('header', null, h('h1', null, page.title), page.subtitle && h('p', { class: 'subtitle' }, page.subtitle)),
      h('nav', { 'aria-label': 'Contents' }, page.sections.map((s) => h('a', { href: `#${slug(s.title)}` }, s.title))), ...elements);
    this.slots = blocks.flat();
    this.slots.forEach((slot) => this.#watchNumbers(slot));
    this.slots.filter((slot) => isInSight(slot.element)).forEach((slot) => chartsIn(slot.element).forEach((chart) => chart.draw()));
  }

  #update(page) {
    clearTimeout(this.later);
    this.element.querySelector('.subtitle')?.replaceChildren(page.subtitle);
    const next = page.sections.flatMap((section) => section.blocks.map((block) => ({ block, section })));
    next.forEach(({ block, section }, i) => Object.assign(this.slots[i], { next: block, section }));
    const refreshAll = (slots) => slots.filter((slot) => slot.next).forEach((slot) => this.#refresh(slot));
    refreshAll(this.slots.filter((slot) => isInSight(slot.element)));
    this.later = setTimeout(() => refreshAll(this.slots), 120);  // a slider that moves on is worth more
  }

  #refresh(slot) {
    const { next } = slot;
    slot.next = null;
    slot.context.section = slot.section;
    if (kInPlace.includes(next.type)) {
      adopt(slot.block, next);
      chartsIn(slot.element).forEach((chart) => chart.refresh());
      slot.isStale = true;
      if (slot.element.querySelector('details.numbers')?.open) this.#renewNumbers(slot);
      return;
    }
    slot.block = next;
    if (slot.clock) slot.clock.listeners = [];
    this.#replace(slot, kBlocks[next.type](next, slot.context));
  }

  #replace(slot, element) {
    const open = [...slot.element.querySelectorAll('details')].map((one) => one.open);
    const drawn = chartsIn(slot.element).some((chart) => chart.instance);
    forgetChartsIn(slot.element);
    slot.element.replaceWith(element);
    slot.element = element;
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
