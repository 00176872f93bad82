// The numbers of a time chart: mean and extremes of each channel in each phase.
import { fixed, clockTime, decimalsFor } from '../format.js';
import { makeTable } from './table.js';

/// Mean over time of the straight lines between points, and the extremes. A point at the end of a phase belongs to the
/// next one, where there is one.
function summarize({ t, y }, start_s, end_s, isLast) {
  let area = 0;
  let width = 0;
  let low = Infinity;
  let high = -Infinity;
  let last = null;
  for (let i = 0; i < t.length; ++i) {
    if (t[i] < start_s - 1e-6 || (isLast ? t[i] > end_s + 1e-6 : t[i] > end_s - 1e-6) || y[i] === null) continue;
    low = Math.min(low, y[i]);
    high = Math.max(high, y[i]);
    if (last !== null) {
      area += ((y[i] + y[last]) / 2) * (t[i] - t[last]);
      width += t[i] - t[last];
    }
    last = i;
  }
  if (last === null) return null;
  return { mean: width > 0 ? area / width : y[last], low, high, end: y[last] };
}

/// What the program found of the rows of a phase.
const fromRows = (found) => found && { mean: found[0], low: found[1], high: found[2], end: found[3] };

export function makePhaseTable(block, span) {
  const phases = block.phases && block.phases.length ? block.phases : [{ name: 'all', start_s: span[0], end_s: span[1] }];
  const rows = [];
  for (const panel of block.panels) {
    for (const series of panel.series) {
      phases.forEach((phase, i) => {
        const found = series.phases ? fromRows(series.phases[i]) : summarize(series, phase.start_s, phase.end_s, i + 1 === phases.length);
        if (!found) return;
        const decimals = decimalsFor(found.low, found.high);
        rows.push([series.name, phase.name, clockTime(phase.start_s), clockTime(phase.end_s),
          ...[found.mean, found.low, found.high, found.end].map((v) => fixed(v, decimals)), panel.unit]);
      });
    }
  }
  return makeTable({ caption: 'Mean, least, most and last value of each channel in each phase',
    columns: ['channel', 'phase', 'from', 'to', 'mean', 'least', 'most', 'last', 'unit'].map((label, i) =>
      ({ label, align: i < 2 || i > 7 ? 'left' : 'right' })), rows });
}
