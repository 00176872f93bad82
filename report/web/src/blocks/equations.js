// Equations of a procedure, typeset when the page is built: {of: name in equations.json}
import equations from '../../equations.json';
import { h } from '../dom.js';

/// The MathML is of this program, made from TeX by build.mjs.
const formula = (mathml) => document.importNode(new DOMParser().parseFromString(mathml, 'application/xml').documentElement, true);

/// "T_s" with its index set lower.
const withIndices = (text) => text.split(/\b([A-Za-z]+_[A-Za-z0-9]+)\b/).map((part, i) => {
  if (i % 2 === 0) return part;
  const [name, index] = part.split('_');
  return [h('i', null, name), h('sub', null, index)];
});

/// Equations by their name; nothing where there are none of this name.
export const typesetEquations = (of) => (equations[of] || []).map(({ mathml, text }) => [
  h('div', { class: 'equation' }, formula(mathml)), text && h('p', null, withIndices(text))]);

export const equationsBlock = ({ of }) => h('div', { class: 'equations' }, typesetEquations(of));
