// The page, made from the payload alone. A payload is {title, subtitle, about, sections: [{title, note, blocks: [...]}]}
// and each block is drawn by the function of its type.
import { barsBlock } from './blocks/bars.js';
import { curvesBlock } from './blocks/curves.js';
import { energyBlock } from './blocks/energy.js';
import { equationsBlock } from './blocks/equations.js';
import { forestBlock } from './blocks/forest.js';
import { inputsBlock } from './blocks/inputs.js';
import { mapBlock, sharesBlock } from './blocks/map.js';
import { linesBlock, tableBlock } from './blocks/table.js';
import { definitionsBlock, leadBlock, preBlock, textBlock, warningsBlock } from './blocks/text.js';
import { tilesBlock } from './blocks/tiles.js';
import { timesBlock } from './blocks/times.js';
import { waterfallBlock } from './blocks/waterfall.js';
import { chartAt, chartCount, drawAll, legendsAndPlots, showTips } from './chart.js';
import { Clock } from './clock.js';
import { h } from './dom.js';
import { animationBlock } from './animation/animation.js';
import { crossSectionBlock } from './animation/section.js';
import { preparePrinting } from './paper.js';
import { makeThemeButton, startTheme } from './theme.js';
import { timeBarBlock } from './timebar.js';

export const kBlocks = {
  bars: barsBlock, cross_section: crossSectionBlock, curves: curvesBlock, definitions: definitionsBlock, energy: energyBlock, equations: equationsBlock, forest: forestBlock, inputs: inputsBlock, lead: leadBlock, lines: linesBlock,
  map: mapBlock, pre: preBlock, animation: animationBlock, shares: sharesBlock, table: tableBlock, text: textBlock,
  tiles: tilesBlock, time_bar: timeBarBlock, times: timesBlock, warnings: warningsBlock,
  waterfall: waterfallBlock,
};

export const slug = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '');

/// `make(block, context)` draws a block.
export function makeSection(section, context, make = (block, it) => kBlocks[block.type](block, it)) {
  const blocks = section.blocks.map((block) => make(block, { ...context, section }));
  const body = section.folded
    ? h('details', { class: 'fold' }, h('summary', null, section.folded), blocks)
    : blocks;
  return h('section', { id: slug(section.title), class: section.class },
    h('h2', null, section.title), section.note && h('p', { class: 'note' }, section.note), body);
}

function makeHeader(payload) {
  return h('header', null,
    h('div', { class: 'top' },
      h('span', { class: 'brand' }, 'rollrig ', h('span', null, payload.command)),
      h('div', { class: 'tools' }, makeThemeButton(),
        h('button', { type: 'button', class: 'tool', onclick: () => print() }, 'Print'))),
    h('h1', null, payload.title), payload.subtitle && h('p', { class: 'subtitle' }, payload.subtitle),
    h('p', { class: 'about' }, payload.about));
}

function makeContents(sections) {
  return h('nav', { 'aria-label': 'Contents' }, sections.map((s) => h('a', { href: `#${slug(s.title)}` }, s.title)));
}

function start() {
  const payload = JSON.parse(document.getElementById('payload').textContent);
  startTheme();
  document.title = `${payload.title} \u2013 rollrig`;
  const clock = payload.clock ? new Clock(payload.clock.start_s, payload.clock.end_s, payload.clock.now_s) : null;
  const context = { clock, payload };
  const main = h('main', { id: 'content', tabindex: '-1' }, payload.sections.map((section) => makeSection(section, context)));
  document.getElementById('page').replaceChildren(makeHeader(payload), makeContents(payload.sections), main,
    h('footer', null, h('p', null, payload.about), h('p', null, 'This page needs no network. Charts: Apache ECharts, Apache License 2.0.')));
  preparePrinting();
  window.rollrig = { clock, drawAll, chartAt, chartCount, legendsAndPlots, showTips };
  document.documentElement.dataset.ready = 'yes';
}

if (document.getElementById('payload')) start();  // another page makes its sections itself
