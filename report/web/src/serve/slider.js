// A number with its slider, its field and a way back to the default.
import { h } from '../dom.js';
import { number } from '../format.js';
import { notANumber, readNumber } from './number_field.js';
import { makeProblem } from './problem.js';

/// "Load accuracy" of "load accuracy".
export const capitalized = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/// A unit as a person writes it.
const unitText = (unit) => unit.replace('degC', '\u00b0C');

/// A step that makes about so many positions: 1, 2 or 5 times a power of ten.
function niceStep(span, positions) {
  const raw = span / positions;
  const power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= raw * 0.999);
}

const rounded = (value, step) => Number((Math.round(value / step) * step).toPrecision(12));

/// Ends of a slider about a default: an ordinary range of temperatures, else from four tenths to sixteen tenths of it.
/// Assumed: what one tries; the field beside it takes every number that is allowed.
function spanAbout(value, { unit, lower, upper }) {
  const size = Math.abs(value) || 1;
  const [from, to] = unit === 'degC' ? [Math.min(-10, value), Math.max(45, value)] : value === 0 ? [-1, 1] : [value - 0.6 * size, value + 0.6 * size];
  return [Math.max(from, lower ?? -Infinity), Math.min(to, upper ?? Infinity)];
}

export class Slider {
  /// `info` is a control of the server's choices; `onInput(slider)` hears every change by the person.
  constructor(info, { onInput, id }) {
    this.info = info;
    this.id = id;
    this.value = null; // of the person; null: the default
    // A field of type number drops a comma without a word: "1,5" would be 15.
    this.field = h('input', { type: 'text', inputmode: 'decimal', autocomplete: 'off', id: `${id}-field`, class: 'field', 'aria-label': `${info.label}, ${info.unit || 'number'}` });
    this.range = h('input', { type: 'range', id, min: 0, max: 1, step: 'any', title: info.doc });
    this.reset = h('button', { type: 'button', class: 'reset', title: 'Back to the default', 'aria-label': `${info.label}: back to the default`, disabled: true }, '\u21ba');
    this.message = h('div', { class: 'beside' });
    this.element = h('div', { class: 'control' },
      h('div', { class: 'controlhead' }, h('label', { for: id, title: info.doc }, capitalized(info.label)), this.field, h('span', { class: 'unit' }, unitText(info.unit)), this.reset),
      this.range, this.message);
    this.range.addEventListener('input', () => this.#take(rounded(Number(this.range.value), this.step), onInput));
    this.field.addEventListener('change', () => {
      const written = readNumber(this.field.value);
      if (Number.isFinite(written)) this.#take(written, onInput);
      else this.setProblem(notANumber(this.field.value));
    });
    this.reset.addEventListener('click', () => {
      this.value = null;
      if (this.fallback !== undefined) this.#show(this.fallback);
      onInput(this);
    });
    if (info.from !== undefined) this.#setSpan(info.from, info.to);
  }

  #take(value, onInput) {
    this.value = value;
    this.#show(value);
    onInput(this);
  }

  #setSpan(from, to) {
    this.step = niceStep(to - from || 1, 200);
    const [low, high] = [Math.floor(from / this.step + 1e-9) * this.step, Math.ceil(to / this.step - 1e-9) * this.step];
    Object.assign(this.range, { min: Math.max(low, this.info.lower ?? -Infinity), max: Math.min(high, this.info.upper ?? Infinity), step: this.step });
    this.hasSpan = true;
  }

  #show(value) {
    const text = String(Number(value.toPrecision(6)));
    if (document.activeElement !== this.field) this.field.value = text;
    this.range.value = value;
    this.range.setAttribute('aria-valuetext', `${number(value)} ${unitText(this.info.unit)}`);
    this.reset.disabled = this.value === null;
    this.element.classList.toggle('moved', this.value !== null);
  }

  /// The value that the last run used: the default, unless the person has moved it.
  setUsed(used) {
    this.element.hidden = used === null || used === undefined;
    if (this.element.hidden) return;
    const isMoved = this.value !== null;
    const isNew = !isMoved && this.fallback !== used;
    if (!this.hasSpan || (isNew && this.info.from === undefined)) this.#setSpan(...spanAbout(used, this.info));
    if (!isMoved) this.fallback = used;
    this.#show(isMoved ? this.value : used);
  }

  setProblem(problem) {
    this.message.replaceChildren(...(problem ? [makeProblem(problem, ['key'])] : []));
    this.element.classList.toggle('wrong', Boolean(problem));
  }
}
