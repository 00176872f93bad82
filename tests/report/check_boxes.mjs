// Opens pages of rollrig in one headless Chromium, each 1400, 768 and 420 px wide, light and dark, and on A4, and compares
// boxes: no text lies over another, over a legend or out of its chart or page; nothing is cut; no printed page is nearly
// empty; nothing is said on the console. One line a page; exit status 1 where one is bad.
// node check_boxes.mjs <page.html>... [--screenshots DIR]
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium } from './chromium.mjs';
import { kFindProblems } from './find_problems.mjs';

const kWidths = [1400, 768, 420];
const kPaper_px = 680; // of the page's own style: A4 without its margins
const kLeastInk = 0.004; // of a printed page: a heading alone has less
const kLeastFilled = 0.4; // of its height: a figure that does not fit goes to the next page, but is no higher than the rest of one
const kLeastLast = 0.12; // of the height of the last one, where the page may end: more than a few lines
const args = process.argv.slice(2);
const shots = args.includes('--screenshots') ? args[args.indexOf('--screenshots') + 1] : undefined;
const pages = args.filter((arg, i) => arg.endsWith('.html') && args[i - 1] !== '--screenshots').map((page) => resolve(page));
let bad = 0;

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

/// Share of ink of each printed page, and how far down it goes, by pdftoppm in gray.
function measurePages(pdf) {
  const folder = mkdtempSync(join(tmpdir(), 'rollrig-paper-'));
  try {
    const file = join(folder, 'page.pdf');
    writeFileSync(file, pdf);
    const { stdout } = spawnSync('pdftoppm', ['-gray', '-r', '30', file], { maxBuffer: 1 << 28 });
    const sheets = [];
    for (let at = 0; at < stdout.length;) {
      const head = /^P5\s+(\d+)\s+(\d+)\s+255\s/.exec(stdout.subarray(at, at + 40).toString('latin1'));
      const size = Number(head[1]) * Number(head[2]);
      const pixels = stdout.subarray(at + head[0].length, at + head[0].length + size);
      let last = 0;
      const dark = pixels.reduce((sum, pixel, i) => (pixel < 230 ? ((last = i), sum + 1) : sum), 0);
      sheets.push({ ink: dark / size, filled: last / size });
      at += head[0].length + size;
    }
    return sheets;
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
  const sheets = measurePages(pdf);
  const isLast = (i) => i > 0 && i + 1 === sheets.length;
  const problems = sheets.flatMap(({ ink, filled }, i) => [
    !isLast(i) && ink < kLeastInk && `printed page ${i + 1} of ${sheets.length} is nearly empty: ${(100 * ink).toFixed(2)} % ink`,
    filled < (isLast(i) ? kLeastLast : sheets.length > 1 ? kLeastFilled : 0) && `printed page ${i + 1} of ${sheets.length} ends at ${Math.round(100 * filled)} % of its height`].filter(Boolean));
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
  note('console', messages.splice(0));
  console.log(`${found.size ? 'BAD' : 'ok '}  ${basename(page)}`);
  for (const [problem, where] of found) console.log(`     ${where.join(', ')}: ${problem}`);
  bad += found.size;
}

const messages = [];
chromium.on((method, params) => {
  if (method === 'Runtime.exceptionThrown') messages.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
  if (method === 'Log.entryAdded') messages.push(params.entry.text);
});
try {
  await chromium.open();
  for (const page of pages) await checkPage(page);
} finally {
  await chromium.close();
}
process.exit(bad ? 1 : 0);
