// A field for a number, with what is wrong with it beside it.
import { h } from '../dom.js';
import { makeProblem } from './problem.js';

/// The number that a person has written, with a point or a comma; NaN where it is none.
export const readNumber = (text) => (text.trim() === '' ? NaN : Number(text.trim().replace(',', '.')));

export const notANumber = (text) => (text.trim() === ''
  ? { what: 'a number is missing', allowed: 'a number such as 1.5' }
  : { what: 'this is no number', value: text, allowed: 'a number such as 1.5' });

/// A field and the place of its message. A field of type number drops a comma without a word: "1,5" would be 15. An empty
/// field gives undefined where it `mayBeEmpty`; what is no number is refused beside the field, and `onNumber` not called.
export function makeNumberField({ value = '', mayBeEmpty = false, onNumber, ...attributes }) {
  const message = h('div', { class: 'beside' });
  const field = h('input', { type: 'text', inputmode: 'decimal', autocomplete: 'off', class: 'field', value, ...attributes, onchange: () => {
    const written = readNumber(field.value);
    const isEmpty = mayBeEmpty && field.value.trim() === '';
    const isWrong = !isEmpty && !Number.isFinite(written);
    message.replaceChildren(...(isWrong ? [makeProblem(notANumber(field.value))] : []));
    field.setAttribute('aria-invalid', String(isWrong));
    if (!isWrong) onNumber(isEmpty ? undefined : written);
  } });
  return { field, message };
}
