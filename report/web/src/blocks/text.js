// Words: a lead sentence with a verdict, paragraphs, warnings, files as they are.
import { h } from '../dom.js';
import { typeset } from '../format.js';
import { typesetEquations } from './equations.js';

/// {tone: good | doubt | bad, text, more}
export function leadBlock({ tone, text, more }) {
  const signs = { good: '\u2713', doubt: '?', bad: '!' };
  return h('div', { class: `lead ${tone || ''}` },
    signs[tone] && h('span', { class: 'sign', 'aria-hidden': 'true' }, signs[tone]),
    h('div', null, h('p', null, typeset(text)), more && h('p', { class: 'more' }, typeset(more))));
}

/// {paragraphs: [...]} or {items: [...]}
export function textBlock({ paragraphs = [], items }) {
  return h('div', { class: 'text' }, paragraphs.map((text) => h('p', null, text)),
    items && h('ul', null, items.map((text) => h('li', null, text))));
}

export function warningsBlock({ items }) {
  return h('ul', { class: 'warnings' }, items.map((text) => h('li', null, h('strong', null, 'Warning '), text)));
}

/// Terms and what they mean: {title, items: [{term, texts: [...], code, of}]}; with `of`, equations of this name instead.
export function definitionsBlock({ title, items }) {
  return h('div', { class: 'definitions' }, title && h('h3', null, title),
    h('dl', null, items.map(({ term, texts = [], code, of }) => [
      h('dt', null, term), of && h('dd', { class: 'equations' }, typesetEquations(of)), ...texts.map((text) => h('dd', null, code ? h('code', null, text) : text))])));
}

/// {caption, text}
export function preBlock({ caption, text }) {
  return h('figure', null, caption && h('figcaption', null, caption), h('pre', { tabindex: '0' }, text));
}
