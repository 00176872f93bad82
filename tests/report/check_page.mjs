// Opens a page of rollrig in headless Chromium and checks it. One line a finding; exit status 1 where one is bad.
// node check_page.mjs <page.html> [--charts N] [--animation] [--section] [--equations N] [--recording FILE.csv] [--shows TEXT [--texts-alone]] [--screenshots DIR]
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium } from './chromium.mjs';

const kFirstPaint_s = 1;
const kLoads = 5;  // the first paint is a figure of the page, not of what else the machine does: the quickest of so many
const kPatience_ms = 20000;
const kBrowsers = 3;
const kSaved = 4;  // charts of a page whose data is saved: a page may have twenty of a kind
const args = process.argv.slice(2);
const option = (name) => (args.includes(name) ? args[args.indexOf(name) + 1] : undefined);
const page = resolve(args[0]);
const problems = [];
const check = (isGood, text) => {
  console.log(`${isGood ? 'ok' : 'BAD'}  ${text}`);
  if (!isGood) problems.push(text);
};

let chromium;
let stalled = false;  // the browser did not do in time what the page asked of it
const messages = [];
const requests = [];
const hear = (method, params) => {
  if (method === 'Runtime.exceptionThrown') messages.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
  if (method === 'Log.entryAdded') messages.push(params.entry.text);
  if (method === 'Runtime.consoleAPICalled') messages.push(params.args.map((a) => a.value ?? a.description).join(' '));
  if (method === 'Network.requestWillBeSent' && !/^(data|blob|about):/.test(params.request.url)) requests.push(params.request.url);
};

/// Share of the pixels of an area that differ from its most frequent color, and how many colors it has.
const kMeasureInk = `async (png) => {
  const image = await createImageBitmap(await (await fetch('data:image/png;base64,' + png)).blob());
  const canvas = new OffscreenCanvas(image.width, image.height);
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const { data } = context.getImageData(0, 0, image.width, image.height);
  const counts = new Map();
  for (let i = 0; i < data.length; i += 4) {
    const color = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
    counts.set(color, (counts.get(color) || 0) + 1);
  }
  const pixels = data.length / 4;
  return { ink: 1 - Math.max(...counts.values()) / pixels, colors: counts.size };
}`;

/// What is really seen of an element, as PNG.
async function capture(selector, index) {
  const box = await chromium.evaluate(`(() => { const b = document.querySelectorAll('${selector}')[${index}].getBoundingClientRect();
    return { x: b.x + scrollX, y: b.y + scrollY, width: b.width, height: b.height }; })()`);
  const { data } = await chromium.send('Page.captureScreenshot', { clip: { ...box, scale: 1 }, captureBeyondViewport: true });
  return { png: data, box };
}

// Pixels are read in an empty tab: the report's policy allows it no fetch.
let measuring;
async function measureInk(png) {
  if (!measuring) measuring = await chromium.openTab();
  return chromium.evaluate(`(${kMeasureInk})('${png}')`, measuring);
}

async function checkCharts() {
  const count = await chromium.evaluate(`(rollrig.drawAll(), document.querySelectorAll('.chart').length)`);
  const wanted = Number(option('--charts') || 0);
  check(count >= wanted, `${count} charts, at least ${wanted} wanted`);
  for (let i = 0; i < count; ++i) {
    const { png, box } = await capture('.chart', i);
    const { ink, colors } = await measureInk(png);
    check(box.height > 100 && ink > 0.005 && colors > 8, `chart ${i + 1}: ${(100 * ink).toFixed(1)} % of its pixels drawn, ${colors} colors, ${Math.round(box.height)} px high`);
  }
}

/// A tooltip over each panel of the first chart over time: it names quantity, unit and every series of that panel alone, and
/// stays in the window.
async function checkTooltips() {
  const places = await chromium.evaluate(`(() => {
    const block = JSON.parse(document.getElementById('payload').textContent).sections.flatMap((s) => s.blocks).find((b) => b.type === 'times');
    const element = document.querySelector('.times .chart');
    if (!block || !element) return [];
    const { instance } = rollrig.chartAt(element);
    return block.panels.map((panel, i) => ({ label: panel.label, unit: panel.unit, series: panel.series.map((s) => s.name),
      others: block.panels.filter((one) => one.label !== panel.label).map((one) => one.label + ', ' + one.unit), rect: instance.getModel().getComponent('grid', i + 1).coordinateSystem.getRect() })); })()`);
  for (const { label, unit, series, others, rect } of places) {
    // The panel at the foot of the window, where a tooltip has least room.
    const at = await chromium.evaluate(`(() => { const element = document.querySelector('.times .chart');
      scrollBy(0, element.getBoundingClientRect().top + ${rect.y + rect.height} - innerHeight + 4);
      const box = element.getBoundingClientRect(); return { x: box.left + ${rect.x + rect.width - 12}, y: box.top + ${rect.y + 0.6 * rect.height} }; })()`);
    for (const dx of [-30, 0]) await chromium.send('Input.dispatchMouseEvent', { type: 'mouseMoved', x: at.x + dx, y: at.y });
    await waitFor(`[...document.querySelector('.times .chart').children].slice(1).some((tip) => tip.textContent.includes(${JSON.stringify(`${label}, ${unit}`)}))`);
    const { text, box, room } = await chromium.evaluate(`(() => { const tip = document.querySelector('.times .chart').children[1]; const { left, top, right, bottom } = tip.getBoundingClientRect();
      return { text: tip.textContent, box: { left, top, right, bottom }, room: [innerWidth, innerHeight] }; })()`);
    check(text.includes(`${label}, ${unit}`) && series.every((name) => text.includes(`${name}:`)) && !others.some((other) => text.includes(other)),
      `the tooltip over ${label} names it, its unit and its series alone: ${text.slice(0, 120)}`);
    check(box.left >= -1 && box.top >= -1 && box.right <= room[0] + 1 && box.bottom <= room[1] + 1, `the tooltip over ${label} is in the window: ${JSON.stringify(box)} of ${room}`);
  }
  await chromium.evaluate('(scrollTo(0, 0), 0)');
}

/// The slider by keyboard: the drawing, the values and the cursor move.
async function checkAnimation() {
  const look = `(() => ({ drawing: [...document.querySelectorAll('.animation g[transform]')].map((g) => g.getAttribute('transform')).join(),
    values: document.querySelector('.readings').textContent, cursor: document.querySelector('.cursor').style.transform, now: document.querySelector('.now').textContent }))()`;
  const before = await chromium.evaluate(look);
  const picture = await capture('.animation', 0);
  check((await measureInk(picture.png)).ink > 0.02, 'the animation is drawn');
  await chromium.evaluate(`document.querySelector('#time').focus()`);
  for (const type of ['keyDown', 'keyUp']) await chromium.send('Input.dispatchKeyEvent', { type, key: 'PageDown', code: 'PageDown', windowsVirtualKeyCode: 34 });
  const after = await chromium.evaluate(look);
  for (const key of ['drawing', 'cursor', 'now']) check(before[key] !== after[key], `the slider moves the animation: ${key}`);
  const moved = await capture('.animation', 0);
  check(moved.png !== picture.png, 'the picture of the animation changes');
  await chromium.evaluate(`(rollrig.clock.set(rollrig.clock.start_s), 0)`);
  const start = await chromium.evaluate(look);
  check(start.values !== before.values, 'the slider moves the values beside it');
}

/// The readings beside the animation are those of the recording's last row at or before the time of the slider. Every
/// change of phase is looked at from both sides.
async function checkReadings(file) {
  const [head, ...rows] = readFileSync(file, 'utf8').trim().split('\n').map((line) => line.split(','));
  const time_s = rows.map((row) => Number(row[0]));
  const start_s = await chromium.evaluate('rollrig.clock.start_s');
  const looked = new Set([Math.floor(rows.length / 2)]);
  rows.forEach((row, i) => i > 0 && row[1] !== rows[i - 1][1] && [i - 1, i, i + 1].forEach((k) => looked.add(k)));
  let compared = 0;
  let wrong = '';
  for (const i of [...looked].filter((k) => k + 1 < rows.length && time_s[k] >= start_s)) {
    const between_s = 0.5 * (time_s[i] + time_s[i + 1]);
    const shown = await chromium.evaluate(`(rollrig.clock.set(${between_s}), [...document.querySelectorAll('.readings tbody tr')].map((tr) => [...tr.children].map((cell) => cell.textContent)))`);
    for (const [name, text, unit] of shown) {
      const column = head.indexOf(`${name.replaceAll(' ', '_')}_${unit.replace('\u00b0C', 'degC').replace('km/h', 'km_h')}`);
      if (column < 0) continue;
      const value = Number(text.replace('\u2212', '-'));
      const digit = 10 ** -(text.split('.')[1] || '').length;
      ++compared;
      if (!(Math.abs(value - Number(rows[i][column])) <= 1.1 * digit)) wrong = `${name} ${text} at ${between_s} s, recorded ${rows[i][column]}`;
    }
  }
  check(compared > 50 && wrong === '', `${compared} readings are those of the recording's rows: ${wrong}`);
}

/// Clicks with the mouse in the middle of an element.
async function click(selector, index) {
  const { x, y } = await chromium.evaluate(`(() => { const e = document.querySelectorAll('${selector}')[${index}]; e.scrollIntoView({ block: 'center' });
    const b = e.getBoundingClientRect(); return { x: b.x + b.width / 2, y: b.y + b.height / 2 }; })()`);
  for (const type of ['mousePressed', 'mouseReleased']) await chromium.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', clickCount: 1 });
}

/// The file that a way of the menu of a chart gives: name and bytes.
async function saveChart(index, way, folder) {
  let ended;
  const saved = new Promise((done) => (ended = done));
  let begun;
  const stop = chromium.on((method, params) => {
    if (method === 'Browser.downloadWillBegin') begun = params;
    if (method === 'Browser.downloadProgress' && params.guid === begun?.guid && params.state !== 'inProgress') ended();
  });
  await click('.save summary', index);
  await click(`.save[open] button`, way);
  const late = setTimeout(() => {
    stalled = true;
    ended();
  }, kPatience_ms);
  await saved;
  clearTimeout(late);
  stop();
  const name = begun?.suggestedFilename ?? 'nothing';
  const file = join(folder, name);
  return { name, bytes: existsSync(file) ? readFileSync(file) : Buffer.alloc(0) };
}

/// Numbers of a chart's block in the page's data, in the order of its kind.
const kNumbersOf = {
  bars: (b) => b.series.flatMap((s) => [s.values, s.low, s.high]),
  curves: (b) => b.series.flatMap((s) => [s.x, s.y, s.low, s.high]),
  energy: (b) => b.ledgers.map((l) => l.terms.map((t) => t.in_J)),
  forest: (b) => b.rows.flatMap((row) => [row, row.prior].filter(Boolean).map(({ value, low, high }) => [value, low, high])),
  times: (b) => [[...new Set(b.panels.flatMap((p) => p.series.flatMap((s) => s.t.filter((t) => !isHeld(s, t)))))], ...b.panels.flatMap((p) => p.series.map((s) => s.y.filter((_, i) => !isHeld(s, s.t[i]))))],
  waterfall: (b) => ['value', 'low', 'high'].map((key) => [b.start, ...b.steps, b.end].map((bar) => bar[key])),
};
/// Likewise of what is no chart; numbers that are texts count.
const kNumbersOfOthers = {
  cross_section: (b) => [b.t, ...b.nodes.map((node) => node.degC), b.generated_W, b.to_air_W, b.to_surface_W, b.stored_W, ...b.links.map((link) => link.W)],
  map: (b) => b.rows.flatMap(({ group, label, cells }) => [group, label, ...cells.map((cell) => cell?.text)]).map(asNumber),
  shares: (b) => b.rows.flatMap(({ label, share }) => [asNumber(label), share]),
};
const isHeld = (series, t) => Boolean(series.held?.includes(t)); // drawn, but no row
const asNumber = (text) => (text === undefined || text === '' || Number.isNaN(Number(text)) ? text : Number(text));
const kTextColumns = /^(balance|category|kind|name|series|step|term|unit|.*_note)$/;
const sorted = (numbers) => numbers.flat().filter((n) => typeof n === 'number').sort((a, b) => a - b).join();

/// The cells of a line of CSV.
const splitCsv = (line) => [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map((m) => (m[1] !== undefined ? m[1].replaceAll('""', '"') : m[2]));

/// What is no chart is saved as well: its numbers, and pictures that show something.
async function checkSavedOther(block, index, folder) {
  const csv = await saveChart(index, 0, folder);
  const cells = csv.bytes.toString().trimEnd().split('\n').slice(1).flatMap(splitCsv).filter((cell) => cell !== '');
  check(csv.name.endsWith('.csv') && sorted(cells.map(asNumber)) === sorted(kNumbersOfOthers[block.type](block)), `${csv.name} has the numbers of the ${block.type}`);
  const svg = await saveChart(index, 1, folder);
  const texts = [...svg.bytes.toString().matchAll(/<text[^>]*>/g)].length;
  check(/^<svg[^>]+xmlns/.test(svg.bytes.toString()) && texts >= 3, `${svg.name} is a picture with ${texts} texts`);
  const png = await saveChart(index, 2, folder);
  check(png.name.endsWith('.png') && (await measureInk(png.bytes.toString('base64'))).ink > 0.005, `${png.name} is the picture`);
}

/// The menu of each of the first charts saves the numbers of its block, all digits of them, and its picture.
async function checkSaving() {
  const folder = mkdtempSync(join(tmpdir(), 'rollrig-saved-'));
  try {
    await chromium.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder, eventsEnabled: true });
    const payload = JSON.parse(await chromium.evaluate(`document.getElementById('payload').textContent`));
    const blocks = payload.sections.flatMap((section) => section.blocks).filter((block) => kNumbersOf[block.type] || kNumbersOfOthers[block.type]);
    const charts = blocks.flatMap((block, i) => (kNumbersOf[block.type] ? [i] : []));
    const count = await chromium.evaluate(`document.querySelectorAll('.save').length`);
    check(count === blocks.length && charts.length === await chromium.evaluate(`document.querySelectorAll('.chart').length`), `${count} charts, maps, shares and drawings have a menu that saves them`);
    await chromium.evaluate(`(document.querySelectorAll('details.fold').forEach((fold) => (fold.open = true)), rollrig.drawAll(), 0)`);
    for (const i of charts.slice(0, kSaved)) {
      const { name, bytes } = await saveChart(i, 0, folder);
      const [head, ...rows] = bytes.toString().trimEnd().split('\n').map(splitCsv);
      const columns = head.map((_, c) => c).filter((c) => !kTextColumns.test(head[c]));
      const numbers = columns.map((c) => rows.map((row) => row[c]).filter((cell) => cell !== '').map(Number));
      const isWhole = rows.length > 0 && rows.every((row) => row.length === head.length) && new Set(head).size === head.length;
      check(/^[^\s/]+\.csv$/.test(name) && isWhole && sorted(numbers) === sorted(kNumbersOf[blocks[i].type](blocks[i])),
        `chart ${i + 1}: ${name} has the ${numbers.flat().length} numbers of the page's data in ${head.join(', ').slice(0, 160)}`);
    }
    for (const type of Object.keys(kNumbersOfOthers)) {
      const i = blocks.findIndex((block) => block.type === type);
      if (i >= 0) await checkSavedOther(blocks[i], i, folder);
    }
    if (!charts.length) return;
    const svg = await saveChart(charts[0], 1, folder);
    check(/^<svg[^>]+xmlns/.test(svg.bytes.toString()) && svg.name.endsWith('.svg') && svg.bytes.length > 2000, `${svg.name} is a picture of ${svg.bytes.length} bytes`);
    const png = await saveChart(charts[0], 2, folder);
    const width = await chromium.evaluate(`document.querySelector('.chart').clientWidth`);
    const isWide = png.bytes.length > 100 && png.bytes.readUInt32BE(16) === 2 * width;
    check(png.name.endsWith('.png') && isWide && (await measureInk(png.bytes.toString('base64'))).ink > 0.005, `${png.name} is the picture at twice its width`);
  } finally {
    rmSync(folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

/// The section through the tire moves with the slider, and shows the flows of the page's data: what arises goes to air and
/// surface, or is stored.
async function checkSection() {
  const look = `(() => ({ flows: [...document.querySelectorAll('.crosssection .flow')].map((flow) => flow.getAttribute('d')).join(), colors: [...document.querySelectorAll('.crosssection [fill]')].map((part) => part.getAttribute('fill')).join(),
    shown: Object.fromEntries([...document.querySelectorAll('.crosssection .flowlabel')].map((text) => [text.firstChild.textContent, text.lastChild.textContent])),
    stored: [...document.querySelectorAll('.heatvalues tr')].find((row) => row.textContent.startsWith('stored')).children[1].textContent }))()`;
  const block = await chromium.evaluate(`JSON.parse(document.getElementById('payload').textContent).sections.flatMap((s) => s.blocks).find((b) => b.type === 'cross_section')`);
  const watt = (text) => Number(text.replace('\u2212', '-').replace(' W', ''));
  let wrong = '';
  let looks = 0;
  let before;
  let moved = 0;
  for (let i = 0; i < block.generated_W.length; i += Math.ceil(block.generated_W.length / 12)) {
    const time_s = 0.5 * (block.t[i] + block.t[i + 1]);
    const now = await chromium.evaluate(`(rollrig.clock.set(${time_s}), ${look})`);
    if (before && before.flows !== now.flows && before.colors !== now.colors) ++moved;
    before = now;
    if (time_s < await chromium.evaluate('rollrig.clock.start_s')) continue; // a soak, before the slider begins
    ++looks;
    const flows = [now.shown.loss, now.shown['to air'], now.shown[`to ${block.surface}`], now.stored].map(watt);
    const given = [block.generated_W, block.to_air_W, block.to_surface_W, block.stored_W].map((values) => values[i]);
    if (!flows.every((flow, k) => Math.abs(flow - given[k]) <= 0.51)) wrong = `${flows} W shown at ${time_s} s, ${given} W given`;
    const left_W = flows[0] - flows[1] - flows[2] - flows[3];
    if (!(Math.abs(left_W) <= 2.1)) wrong = `${left_W} W are left over at ${time_s} s`; // four numbers, each rounded to a watt
  }
  check(looks > 3 && wrong === '', `the section shows flows that add up, at ${looks} times: ${wrong}`);
  check(moved > 2, `arrows and colors of the section move with the slider, ${moved} times`);
  check((await measureInk((await capture('.crosssection', 0)).png)).ink > 0.05, 'the section is drawn');
}

async function checkWords() {
  const odd = await chromium.evaluate(`(document.querySelector('main').textContent.match(/.{0,40}(\\[object|undefined|NaN|Infinity).{0,20}/) || [''])[0]`);
  check(odd === '', `no word that a person is not to see: ${odd}`);
}

async function checkAccess() {
  const unnamed = await chromium.evaluate(`[...document.querySelectorAll('.chart, .animation, input, select, button')].filter((e) =>
    !(e.getAttribute('aria-label') || e.textContent.trim() || (e.labels && e.labels.length))).length`);
  check(unnamed === 0, `${unnamed} charts or controls without a name for a screen reader`);
  const tables = await chromium.evaluate(`[...document.querySelectorAll('figure')].filter((f) => f.querySelector('.chart') && !f.querySelector('details.numbers table tbody tr')).length`);
  check(tables === 0, `${tables} charts without their numbers as a table`);
  const wide = await chromium.evaluate(`document.documentElement.scrollWidth - innerWidth`);
  check(wide <= 0, `the page is ${wide} px wider than the window`);
}

async function checkNarrow() {
  await chromium.send('Emulation.setDeviceMetricsOverride', { width: 400, height: 800, deviceScaleFactor: 1, mobile: false });
  const fits = await waitFor('innerWidth === 400 && document.documentElement.scrollWidth <= innerWidth');
  const wide = await chromium.evaluate(`document.documentElement.scrollWidth - innerWidth`);
  check(fits, `at 400 px the page is ${wide} px wider than the window`);
  await saveScreenshot('narrow');
  await chromium.send('Emulation.clearDeviceMetricsOverride');
}

async function saveScreenshot(name) {
  if (!option('--screenshots')) return;
  await chromium.evaluate('(rollrig.drawAll(), 0)');
  const { data } = await chromium.send('Page.captureScreenshot', { captureBeyondViewport: true, clip: await chromium.evaluate(
    '({ x: 0, y: 0, width: innerWidth, height: document.documentElement.scrollHeight, scale: 1 })') });
  writeFileSync(join(option('--screenshots'), `${name}.png`), Buffer.from(data, 'base64'));
}

async function checkDarkAndPaper() {
  await chromium.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: 'dark' }] });
  const isDark = await waitFor(`getComputedStyle(document.body).backgroundColor !== 'rgb(255, 255, 255)'`);
  const dark = await chromium.evaluate('getComputedStyle(document.body).backgroundColor');
  check(isDark, `dark where the system is dark: ${dark}`);
  await saveScreenshot('dark');
  await chromium.send('Emulation.setEmulatedMedia', { features: [] });
  const { data } = await chromium.send('Page.printToPDF', { printBackground: true, preferCSSPageSize: true });
  check(data.length > 20000, `prints: a PDF of ${Math.round((data.length * 3) / 4096)} kB`);
  if (option('--screenshots')) writeFileSync(join(option('--screenshots'), 'paper.pdf'), Buffer.from(data, 'base64'));
}

/// Waits until an expression is true in the page, and says whether it came to be. What a page does on a change of its size or
/// theme waits for the next frame, and a headless browser on a busy machine may draw none of its own: a small picture asks
/// for one.
async function waitFor(expression) {
  const end_ms = performance.now() + kPatience_ms;
  while (!(await chromium.evaluate(`Boolean(${expression})`))) {
    if (performance.now() > end_ms) {
      stalled = true;
      return false;
    }
    await chromium.send('Page.captureScreenshot', { clip: { x: 0, y: 0, width: 1, height: 1, scale: 1 } });
    await new Promise((done) => setTimeout(done, 20));
  }
  return true;
}

// What a name in a file may hold. Where it stands on a page it is text: no element comes of it, and none of its scripts runs.
const kHostile = '<img src=x onerror="attacked=1"></script><script>attacked=1</script><svg onload="attacked=1">';
const kWordsOfPages = ['type', 'format', 'kind', 'tone', 'machine', 'align', 'class']; // not of a file: a page's own

/// Tooltips are shown, and no script but the page's own has run.
async function checkHarmless(what) {
  const tips = await chromium.evaluate('rollrig.showTips()');
  check(!tips.length || tips.some((tip) => tip !== ''), `${what}: ${tips.filter((tip) => tip !== '').length} of ${tips.length} tooltips shown`);
  check(!tips.some((tip) => /<(img|script|svg)/.test(tip)), `${what}: no element in a tooltip comes of a name: ${tips.find((tip) => /<(img|script|svg)/.test(tip))?.slice(0, 200) ?? ''}`);
  await new Promise((done) => setTimeout(done, 50)); // an image that is not there says so later
  check(await chromium.evaluate(`typeof attacked === 'undefined' && document.images.length === 0 && document.scripts.length === 2`), `${what}: no script but the page's own has run`);
}

/// The same page with what an attacker may write in each of its texts.
async function checkHostileTexts() {
  const html = readFileSync(page, 'utf8');
  const mark = 'id="payload">';
  const first = html.indexOf(mark) + mark.length;
  const last = html.indexOf('</script>', first);
  const payload = JSON.parse(html.slice(first, last), (key, value) => (typeof value === 'string' && !kWordsOfPages.includes(key) ? value + kHostile : value));
  const folder = mkdtempSync(join(tmpdir(), 'rollrig-hostile-'));
  try {
    const file = join(folder, 'page.html');
    writeFileSync(file, html.slice(0, first) + JSON.stringify(payload).replaceAll('<', '\\u003c') + html.slice(last));
    await load(file);
    check(await waitFor(`document.documentElement.dataset.ready === 'yes'`), 'the page is made of hostile texts');
    await chromium.evaluate('(rollrig.drawAll(), 0)');
    await checkHarmless('hostile texts');
    check(messages.length === 0, `no message on the console: ${messages.join(' | ')}`);
    // Were a name to come through, the policy of the page would still stop its script.
    await chromium.evaluate(`(document.body.insertAdjacentHTML('beforeend', ${JSON.stringify(kHostile)}), 0)`);
    check(await waitFor(`document.images.length === 1 && document.images[0].complete`), 'an element with a handler stands in the page');
    await new Promise((done) => setTimeout(done, 50));
    check(await chromium.evaluate(`typeof attacked === 'undefined'`), 'the policy of the page lets no handler in an attribute run');
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/// Loads the page. Returns the time of its first paint with content, in s.
async function load(file = page) {
  let fire;
  const loaded = new Promise((done) => (fire = done));
  const stop = chromium.on((method) => method === 'Page.loadEventFired' && fire());
  await chromium.send('Page.navigate', { url: pathToFileURL(file).href });
  await loaded;
  stop();
  await waitFor(`performance.getEntriesByName('first-contentful-paint').length > 0`);
  return chromium.evaluate(`performance.getEntriesByName('first-contentful-paint')[0]?.startTime / 1000`);
}

/// What a reader does with the page: equations, menus, tooltips, drawings, a narrow window, the dark theme, paper.
async function checkUse() {
  if (option('--equations')) {
    const drawn = await chromium.evaluate(`[...document.querySelectorAll('.equation math')].filter((math) => math.getBoundingClientRect().width > 20).length`);
    check(drawn === Number(option('--equations')), `${drawn} equations are typeset, ${option('--equations')} wanted`);
  }
  await checkAccess();
  await checkSaving();
  await checkTooltips();
  if (args.includes('--animation')) await checkAnimation();
  if (args.includes('--section')) await checkSection();
  if (option('--recording')) await checkReadings(option('--recording'));
  await checkNarrow();
  await checkDarkAndPaper();
}

async function checkPage() {
  await chromium.open();
  let paint_s = await load();
  check(await waitFor(`document.documentElement.dataset.ready === 'yes'`), 'the page is made from its data');
  let loads = 1;
  for (; loads < kLoads && !(paint_s < kFirstPaint_s); ++loads) paint_s = Math.min(paint_s ?? Infinity, (await load()) ?? Infinity);
  check(paint_s < kFirstPaint_s, `first paint with content after ${paint_s?.toFixed(2)} s (load ${loads}), at most ${kFirstPaint_s} s`);
  await checkCharts();
  await saveScreenshot('light');
  await checkWords();
  await checkHarmless('the page');
  const shown = option('--shows');
  if (shown) check(await chromium.evaluate(`document.querySelector('main').textContent.includes(${JSON.stringify(shown)})`), `the page shows ${shown}`);
  if (!args.includes('--texts-alone')) await checkUse();
  const strange = requests.filter((url) => url !== pathToFileURL(page).href);
  check(strange.length === 0, `nothing but the file itself is asked for: ${strange.join(' ')}`);
  check(messages.length === 0, `no message on the console: ${messages.join(' | ')}`);
  await checkHostileTexts();
}

// A browser that dies or stalls on a machine short of memory or time says nothing of the page: it is started anew, twice at
// most. A page that is at fault fails in every browser.
for (let browsers = 1; ; ++browsers) {
  for (const kept of [problems, messages, requests]) kept.length = 0;
  chromium = new Chromium();
  chromium.on(hear);
  measuring = undefined;
  let died = false;
  stalled = false;
  try {
    await checkPage();
  } catch (error) {
    died = Boolean(chromium.ended);
    check(false, `the check itself: ${error.message}; ${messages.join(' | ')}`);
  } finally {
    await chromium.close();
  }
  if (problems.length === 0 || !(died || stalled) || browsers === kBrowsers) break;
  console.log(`the browser has ${died ? 'died' : 'stalled'}: once more`);
}
process.exit(problems.length === 0 ? 0 : 1);
