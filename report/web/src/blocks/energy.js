// Where the energy goes: {ledgers: [{name, terms: [{name, in_J}]}], links: [[from, to]], closures: [...]}
// Terms above zero bring energy in, terms below carry it off or store it. Energy that leaves the first ledger as the
// second's heat source flows on.
import { axisTitle, baseOption, Chart, chartFoot, tipLine } from '../chart.js';
import { h } from '../dom.js';
import { number, plain } from '../format.js';
import { column } from '../save.js';
import { color } from '../theme.js';
import { makeTable } from './table.js';

const kShown = 1e-3; // of a ledger's inflow; smaller terms stand in the table alone

const inflow = (ledger) => ledger.terms.reduce((sum, term) => sum + Math.max(0, term.in_J), 0);

function unitFor(largest_J) {
  if (largest_J >= 3.6e6) return { symbol: 'kWh', J: 3.6e6 };
  return largest_J >= 1e6 ? { symbol: 'MJ', J: 1e6 } : { symbol: 'kJ', J: 1e3 };
}

/// Nodes and links of the flow. The second ledger's source is fed by the term of the first that it stands for.
function makeFlow(block, unit) {
  const nodes = new Map();
  const links = [];
  const add = (name, tone) => nodes.has(name) || nodes.set(name, { name, itemStyle: { color: color(tone) } });
  const flow = (source, target, value_J) => links.push({ source, target, value: value_J / unit.J });
  block.ledgers.forEach((ledger, l) => {
    const whole = inflow(ledger);
    if (!(whole > 0)) return;
    add(ledger.name, l === 0 ? 'series-1' : 'series-2');
    for (const term of ledger.terms) {
      if (Math.abs(term.in_J) < kShown * whole) continue;
      const name = plain(term.name);
      const passes = (block.links || []).find(([from, to]) => from === term.name || to === term.name);
      if (passes && passes[1] === term.name && nodes.has(plain(passes[0]))) {
        flow(plain(passes[0]), ledger.name, term.in_J);
        continue;
      }
      add(name, passes ? 'series-2' : 'flow');
      if (term.in_J > 0) flow(name, ledger.name, term.in_J);
      else flow(ledger.name, name, -term.in_J);
    }
  });
  return { nodes: [...nodes.values()], links };
}

/// Columns of the flow: nodes on its longest way.
function countColumns(links) {
  const reach = (name) => 1 + Math.max(0, ...links.filter((l) => l.source === name).map((l) => reach(l.target)));
  return Math.max(1, ...links.map((l) => reach(l.source)));
}

function makeOption(block, unit, width) {
  const { nodes, links } = makeFlow(block, unit);
  const isNarrow = width < 600;
  const right = isNarrow ? 84 : 170;
  const label = Math.min(right, (width - right) / Math.max(1, countColumns(links) - 1)) - 18; // px from one column to the next
  const carried = (name) => Math.max(links.filter((l) => l.source === name).reduce((s, l) => s + l.value, 0),
    links.filter((l) => l.target === name).reduce((s, l) => s + l.value, 0));
  return {
    ...baseOption(),
    title: isNarrow ? axisTitle(`Energy, ${unit.symbol}`, false) : undefined,
    tooltip: { ...baseOption().tooltip, formatter: (p) => tipLine(p.dataType === 'edge' ? `${p.data.source} to ${p.data.target}:` : `${p.name}:`, `${number(p.dataType === 'edge' ? p.data.value : p.value)} ${unit.symbol}`) },
    series: [{
      type: 'sankey', left: 4, right, top: isNarrow ? 28 : 14, bottom: 28, nodeWidth: 10, nodeGap: isNarrow ? 46 : 30, draggable: false, nodeAlign: 'left',
      data: nodes, links, layoutIterations: 64, emphasis: { disabled: true },
      label: { color: color('ink'), fontSize: isNarrow ? 10.5 : 12, formatter: (p) => (isNarrow ? `${p.name}\n${number(carried(p.name), 3)}` : `${p.name}\n${number(carried(p.name))}\u00a0${unit.symbol}`), lineHeight: 15, width: label, overflow: 'break' },
      lineStyle: { color: color('flow'), opacity: 0.32, curveness: 0.5 },
    }],
  };
}

function makeNumbers(block, unit) {
  const rows = block.ledgers.flatMap((ledger) => {
    const whole = inflow(ledger);
    return ledger.terms.map((term) => [plain(term.name), ledger.name, term.in_J >= 0 ? 'in' : 'out or stored', number(term.in_J / unit.J),
      whole > 0 ? `${number(100 * Math.abs(term.in_J) / whole, 3)} %` : '\u2013']);
  });
  return makeTable({ caption: `Energy terms over the whole test, ${unit.symbol}`, columns: [{ label: 'term' }, { label: 'balance' }, { label: 'direction' },
    { label: 'energy', unit: unit.symbol, align: 'right' }, { label: 'share of inflow', align: 'right' }], rows });
}

/// A row for each term; what brings energy in is positive.
function makeData({ ledgers }) {
  const terms = ledgers.flatMap((ledger) => ledger.terms.map((term) => ({ ...term, balance: ledger.name })));
  return [column('balance', '', terms.map((t) => t.balance)), column('term', '', terms.map((t) => t.name)), column('energy in', 'J', terms.map((t) => t.in_J))];
}

export function energyBlock(block) {
  const largest = Math.max(...block.ledgers.flatMap((l) => l.terms.map((t) => Math.abs(t.in_J))));
  const unit = unitFor(largest);
  const summary = block.ledgers.map((l) => l.terms.filter((t) => Math.abs(t.in_J) >= kShown * inflow(l))
    .map((t) => `${plain(t.name)} ${number(t.in_J / unit.J)} ${unit.symbol}`).join(', ')).join('; ');
  const chart = new Chart({ height: (width) => (width < 600 ? 500 : 360), label: `Flow of energy: ${summary}`, title: 'Flow of energy', data: () => makeData(block), makeOption: (width) => makeOption(block, unit, width) });
  return h('figure', null, chart.element, h('figcaption', null, block.caption),
    chartFoot(chart, makeNumbers(block, unit)));
}
