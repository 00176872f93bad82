// Opens pages of rollrig in one headless Chromium, each 1400, 768 and 420 px wide, light and dark, and on A4, and compares
// boxes: no text lies over another, over a legend or out of its chart or page; nothing is cut; no printed page is nearly
// empty. One line a page; exit status 1 where one is bad.
// node check_boxes.mjs <page.html>... [--screenshots DIR]
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium } from './chromium.mjs';

const kWidths = [1400, 768, 420];
const kPaper_px = 680; // of the page's own style: A4 without its margins
const kLeastInk = 0.004; // of a printed page but the last: a heading alone has less
const args = process.argv.slice(2);
const shots = args.includes('--screenshots') ? args[args.indexOf('--screenshots') + 1] : undefined;
const pages = args.filter((arg, i) => arg.endsWith('.html') && args[i - 1] !== '--screenshots').map((page) => resolve(page));
let bad = 0;

/// What is wrong with the boxes of the page as it is laid out now, as sentences. Runs in the page.
const kFindProblems = `(() => {
  const problems = new Set();
  const short = (text) => text.trim().replace(/\\s+/g, ' ').slice(0, 40);
  const meet = (a, b, by) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > by && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > by;
  const wide = document.documentElement.classList.contains('paper') ? document.querySelector('#page').getBoundingClientRect().right + 1 : innerWidth;

  // Texts of charts: those of axes, titles and legends stay apart, and inside of their chart.
  for (const chart of document.querySelectorAll('.chart')) {
    const frame = chart.getBoundingClientRect();
    if (frame.height < 80) problems.add('a chart of ' + Math.round(frame.height) + ' px height');
    const texts = [...chart.querySelectorAll('svg text')].map((text) => ({ text: text.textContent, box: text.getBoundingClientRect() })).filter(({ text, box }) => text.trim() && box.width > 0);
    for (const { text, box } of texts) {
      if (box.left < frame.left - 1.5 || box.right > frame.right + 1.5 || box.top < frame.top - 1.5 || box.bottom > frame.bottom + 1.5) problems.add('cut at the edge of its chart: ' + short(text));
    }
    texts.sort((a, b) => a.box.top - b.box.top);
    for (let i = 0; i < texts.length; ++i) {
      for (let k = i + 1; k < texts.length && texts[k].box.top < texts[i].box.bottom; ++k) {
        if (meet(texts[i].box, texts[k].box, 2.5)) problems.add('one over the other: ' + short(texts[i].text) + ' | ' + short(texts[k].text));
      }
    }
    // No legend lies over a plot.
    const instance = rollrig.chartAt(chart);
    for (const { name, legend, plot } of instance ? rollrig.legendsAndPlots(instance) : []) {
      if (meet(legend, plot, 1)) problems.add('a legend over a plot: ' + name);
    }
  }
  // Texts of the page: each inside of the window, not cut by its own box, and none over another.
  const leaves = [...document.querySelectorAll('main h2, main h3, main p, main li, main th, main td, main dt, main dd, main caption, main figcaption, main summary, header h1, header p, nav a, .now, .zoom')]
    .filter((one) => one.offsetParent !== null && one.textContent.trim() && !one.closest('.chart'));
  const boxes = leaves.map((one) => ({ one, box: one.getBoundingClientRect() })).filter(({ box }) => box.width > 0 && box.height > 0);
  for (const { one, box } of boxes) {
    if (one.closest('.scroll')) continue; // it goes on when it is moved
    if (box.right > wide + 1 || box.left < -1) problems.add('beyond the edge of the page: ' + short(one.textContent));
    const style = getComputedStyle(one);
    if (one.scrollWidth > one.clientWidth + 1 && style.display !== 'inline' && style.overflowX !== 'visible') problems.add('cut: ' + short(one.textContent));
  }
  for (const box of document.querySelectorAll('.tile')) {
    if (box.scrollWidth > box.clientWidth + 1 || box.scrollHeight > box.clientHeight + 1) problems.add('beyond its tile: ' + short(box.textContent));
  }
  const inOrder = boxes.filter(({ one }) => !one.querySelector('p, li, td, th, dd, dt')).sort((a, b) => a.box.top - b.box.top);
  for (let i = 0; i < inOrder.length; ++i) {
    for (let k = i + 1; k < inOrder.length && inOrder[k].box.top < inOrder[i].box.bottom; ++k) {
      const [a, b] = [inOrder[i], inOrder[k]];
      if (a.one.contains(b.one) || b.one.contains(a.one) || a.one.closest('.scroll') !== b.one.closest('.scroll')) continue;
      if (meet(a.box, b.box, 2.5)) problems.add('one over the other: ' + short(a.one.textContent) + ' | ' + short(b.one.textContent));
    }
  }
  if (document.documentElement.scrollWidth > innerWidth + 1) problems.add('the page is wider than its window');
  return [...problems];
})()`;

const chromium = new Chromium('chromium', 1400, 1000);
const frame = () => chromium.send('Page.captureScreenshot', { clip: { x: 0, y: 0, width: 1, height: 1, scale: 1 } });

async function waitFor(expression) {
  for (let tries = 0; tries < 400; ++tries) {
    if (await chromium.evaluate(`Boolean(${expression})`)) return;
    await frame();
  }
  throw new Error(`never came: ${expression}`);
}

async function load(page) {
  let fire;
  const loaded = new Promise((done) => (fire = done));
  const stop = chromium.on((method) => method === 'Page.loadEventFired' && fire());
  await chromium.send('Page.navigate', { url: pathToFileURL(page).href });
  await loaded;
  stop();
  await waitFor(`document.documentElement.dataset.ready === 'yes'`);
}

async function save(page, name) {
  if (!shots) return;
  const clip = await chromium.evaluate('({ x: 0, y: 0, width: innerWidth, height: document.documentElement.scrollHeight, scale: 1 })');
  const { data } = await chromium.send('Page.captureScreenshot', { captureBeyondViewport: true, clip });
  writeFileSync(join(shots, `${basename(page, '.html')}.${name}.png`), Buffer.from(data, 'base64'));
}

const media = (theme) => chromium.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: theme }] });
const resize = (width) => chromium.send('Emulation.setDeviceMetricsOverride', { width, height: 1000, deviceScaleFactor: 1, mobile: false });

/// Share of ink of each printed page, by pdftoppm in gray.
function measurePages(pdf) {
  const folder = mkdtempSync(join(tmpdir(), 'rollrig-paper-'));
  try {
    const file = join(folder, 'page.pdf');
    writeFileSync(file, pdf);
    const { stdout } = spawnSync('pdftoppm', ['-gray', '-r', '30', file], { maxBuffer: 1 << 28 });
    const inks = [];
    for (let at = 0; at < stdout.length;) {
      const head = /^P5\s+(\d+)\s+(\d+)\s+255\s/.exec(stdout.subarray(at, at + 40).toString('latin1'));
      const size = Number(head[1]) * Number(head[2]);
      const pixels = stdout.subarray(at + head[0].length, at + head[0].length + size);
      inks.push(pixels.reduce((dark, pixel) => dark + (pixel < 230 ? 1 : 0), 0) / size);
      at += head[0].length + size;
    }
    return inks;
  } finally {
    rmSync(folder, { recursive: true });
  }
}

async function findPaperProblems(page) {
  await media('light');
  await chromium.send('Emulation.clearDeviceMetricsOverride');
  const { data } = await chromium.send('Page.printToPDF', { printBackground: true, preferCSSPageSize: true });
  const pdf = Buffer.from(data, 'base64');
  if (shots) writeFileSync(join(shots, `${basename(page, '.html')}.pdf`), pdf);
  const inks = measurePages(pdf);
  const problems = inks.slice(0, -1).flatMap((ink, i) => (ink < kLeastInk ? [`printed page ${i + 1} of ${inks.length} is nearly empty: ${(100 * ink).toFixed(2)} % ink`] : []));
  await resize(kPaper_px + 40);
  await chromium.send('Emulation.setEmulatedMedia', { media: 'print', features: [] });
  await chromium.evaluate(`(dispatchEvent(new Event('beforeprint')), 0)`);
  await frame();
  problems.push(...(await chromium.evaluate(kFindProblems)));
  await save(page, 'paper');
  await chromium.send('Emulation.setEmulatedMedia', { media: '', features: [] });
  return problems;
}

async function checkPage(page) {
  const found = new Map();
  const note = (where, problems) => problems.forEach((problem) => found.set(problem, [...(found.get(problem) || []), where]));
  await media('light');
  await resize(kWidths[0]);
  await load(page);
  for (const width of kWidths) {
    await resize(width);
    await waitFor(`innerWidth === ${width}`);
    await chromium.evaluate('(rollrig.drawAll(), 0)');
    note(`${width} px`, await chromium.evaluate(kFindProblems));
    await save(page, `${width}`);
  }
  await media('dark');
  await resize(kWidths[0]);
  await waitFor(`document.documentElement.dataset.theme === 'dark'`);
  await chromium.evaluate('(rollrig.drawAll(), 0)');
  note('dark', await chromium.evaluate(kFindProblems));
  await save(page, 'dark');
  note('A4', await findPaperProblems(page));
  console.log(`${found.size ? 'BAD' : 'ok '}  ${basename(page)}`);
  for (const [problem, where] of found) console.log(`     ${where.join(', ')}: ${problem}`);
  bad += found.size;
}

try {
  await chromium.open();
  for (const page of pages) await checkPage(page);
} finally {
  await chromium.close();
}
process.exit(bad ? 1 : 0);
