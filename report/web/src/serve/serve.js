// The page of `rollrig serve`: controls whose runs are simulated as they move, and folders that are diagnosed. Physics
// is in the program alone: this page asks it and draws.
import { chartAt, chartCount, drawAll, legendsAndPlots } from '../chart.js';
import { h } from '../dom.js';
import { preparePrinting } from '../paper.js';
import { makeThemeButton, startTheme } from '../theme.js';
import { get } from './api.js';
import { listenForDrops } from './drop.js';
import { latencies, Live } from './live.js';
import { makeProblem } from './problem.js';
import { Sets } from './sets.js';

const kShownKey = 'rollrig-view'; // of a page that is loaded again
const kViews = [['try', 'Try a test'], ['sets', 'Diagnose a folder']];

function makeViews(views) {
  const tabs = kViews.map(([id, name]) => h('button', { type: 'button', role: 'tab', id: `tab-${id}`, 'aria-controls': `view-${id}`, class: 'tab', onclick: () => show(id) }, name));
  const panels = kViews.map(([id]) => h('div', { id: `view-${id}`, role: 'tabpanel', 'aria-labelledby': `tab-${id}` }, views[id].element));
  const show = (shown) => {
    sessionStorage.setItem(kShownKey, shown);
    kViews.forEach(([id], i) => {
      tabs[i].setAttribute('aria-selected', String(id === shown));
      panels[i].hidden = id !== shown;
    });
  };
  return { tabs: h('div', { role: 'tablist', 'aria-label': 'What to do', class: 'tabs' }, tabs), panels, show };
}

async function start() {
  startTheme();
  const page = document.getElementById('page');
  try {
    const choices = await get('/api/choices');
    const views = { try: new Live(choices), sets: new Sets(choices) };
    const { tabs, panels, show } = makeViews(views);
    page.replaceChildren(
      h('div', { class: 'top' }, h('span', { class: 'brand' }, 'rollrig ', h('span', null, 'serve')), tabs, h('div', { class: 'tools' }, makeThemeButton())),
      ...panels, h('footer', null, h('p', null, `Served by rollrig ${choices.version} on this computer. Charts: Apache ECharts, Apache License 2.0.`)));
    listenForDrops((dropped) => {
      show('sets');
      views.sets.take(dropped);
    });
    const before = sessionStorage.getItem(kShownKey);
    show(before === 'sets' ? 'sets' : 'try');
    if (await views.sets.resume()) show('sets');
    preparePrinting();
  } catch (error) {
    page.replaceChildren(makeProblem(error.problem || { what: error.message }));
  }
  window.rollrig = { chartAt, chartCount, drawAll, latencies, legendsAndPlots };
  document.documentElement.dataset.ready = 'yes';
}

start();
