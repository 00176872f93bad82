// What is wrong with an input, as the command line says it.
import { h } from '../dom.js';

const kLabels = [['file', 'file'], ['line', 'line'], ['key', 'key'], ['value', 'value'], ['allowed', 'allowed'], ['nearest', 'did you mean']];

/// All parts of a problem. `hidden` names parts that the place of the message says already.
export function makeProblem(problem, hidden = []) {
  const parts = kLabels.filter(([key]) => problem[key] && !hidden.includes(key));
  return h('div', { class: 'problem', role: 'alert' }, h('p', null, problem.what),
    parts.length > 0 && h('dl', null, parts.map(([key, label]) => [h('dt', null, label), h('dd', null, String(problem[key]))])));
}
