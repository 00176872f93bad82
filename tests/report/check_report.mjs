// Opens a test report of rollrig in headless Chromium, prints it on A4 and checks the pages. One line a finding; exit
// status 1 where one is bad.
// node check_report.mjs <report.html> [--json RESULT.json] [--shows TEXT] [--keep DIR]
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Chromium } from './chromium.mjs';

const kA4_pt = [595, 842];
const kMargin_pt = 40;  // 14 mm: no text nearer to the edge of the paper than that, but for the number of the page
const args = process.argv.slice(2);
const option = (name) => (args.includes(name) ? args[args.indexOf(name) + 1] : undefined);
const problems = [];
const check = (isGood, text) => {
  console.log(`${isGood ? 'ok' : 'BAD'}  ${text}`);
  if (!isGood) problems.push(text);
};
const messages = [];
const requests = [];
const chromium = new Chromium();
chromium.on((method, params) => {
  if (method === 'Runtime.exceptionThrown') messages.push(params.exceptionDetails.text);
  if (method === 'Log.entryAdded') messages.push(params.entry.text);
  if (method === 'Network.requestWillBeSent' && !/^(data|about):/.test(params.request.url)) requests.push(params.request.url);
});

async function load() {
  let fire;
  const loaded = new Promise((done) => (fire = done));
  const stop = chromium.on((method) => method === 'Page.loadEventFired' && fire());
  await chromium.send('Page.navigate', { url: pathToFileURL(resolve(args[0])).href });
  await loaded;
  stop();
}

/// Words of the printed pages with their boxes, in points: [{ words: [{ text, x1, y1, x2, y2 }] }].
function readPages(pdf) {
  const boxes = execFileSync('pdftotext', ['-bbox', pdf, '-'], { encoding: 'utf8', maxBuffer: 1 << 28 });
  const unescape = (text) => text.replace(/&lt;/g, '<').replace(/&gt;/g, '>').replace(/&quot;/g, '"').replace(/&(#39|apos);/g, "'").replace(/&amp;/g, '&');
  return boxes.split('<page ').slice(1).map((page) => ({
    size: page.match(/width="([\d.]+)" height="([\d.]+)"/).slice(1).map(Number),
    words: [...page.matchAll(/<word xMin="([-\d.]+)" yMin="([-\d.]+)" xMax="([-\d.]+)" yMax="([-\d.]+)">(.*?)<\/word>/g)].map(
      ([, x1, y1, x2, y2, text]) => ({ text: unescape(text), x1: +x1, y1: +y1, x2: +x2, y2: +y2 })),
  }));
}

/// The lines of a page from top to bottom, without the number of the page.
function findLines(page) {
  const lines = [];
  for (const word of page.words.filter((one) => one.y2 < kA4_pt[1] - kMargin_pt).sort((a, b) => a.y1 - b.y1 || a.x1 - b.x1)) {
    const line = lines.find((one) => Math.abs(one.y1 - word.y1) < 3);
    if (line) line.words.push(word);
    else lines.push({ y1: word.y1, words: [word] });
  }
  return lines.map((line) => line.words.sort((a, b) => a.x1 - b.x1).map((word) => word.text).join(' '));
}

/// Every character of the text on the screen is on the paper, none beyond the margins, none covered by a narrow cell.
async function checkText(pages) {
  const flat = (text) => text.replace(/[\s\u00ad]+/g, '');
  const counts = (text) => [...flat(text)].reduce((map, c) => map.set(c, (map.get(c) || 0) + 1), new Map());
  const onScreen = counts(await chromium.evaluate(`document.querySelector('#page').textContent`));
  const onPaper = counts(pages.map((page) => page.words.map((word) => word.text).join('')).join(''));
  const lost = [...onScreen].filter(([c, n]) => (onPaper.get(c) || 0) < n).map(([c, n]) => `${c} ${n - (onPaper.get(c) || 0)}x`);
  check(lost.length === 0, `no character of the page is missing on paper: ${lost.join(', ')}`);
  const beyond = pages.flatMap((page) => page.words).filter((word) => word.x1 < kMargin_pt || word.x2 > kA4_pt[0] - kMargin_pt || word.y1 < kMargin_pt);
  check(beyond.length === 0, `no word is beyond the margins: ${beyond.map((word) => word.text).join(' ')}`);
  const clashes = pages.flatMap((page) => page.words.filter((a) => page.words.some((b) => a !== b &&
    Math.min(a.x2, b.x2) - Math.max(a.x1, b.x1) > 1 && Math.min(a.y2, b.y2) - Math.max(a.y1, b.y1) > 4)));
  check(clashes.length === 0, `no word stands on another: ${clashes.map((word) => word.text).join(' ')}`);
}

/// No page ends with a heading, a title of a table or the head of a table.
async function checkHeadings(pages) {
  const headings = (await chromium.evaluate(`[...document.querySelectorAll('h1, h2, caption')].map((e) => e.textContent)
    .concat([...document.querySelectorAll('thead tr')].map((e) => [...e.children].map((c) => c.textContent).join(' ')))`))
    .map((text) => text.replace(/\s+/g, ' ').trim()).filter((text) => text !== '');
  pages.slice(0, -1).forEach((page, i) => {
    const last = findLines(page).pop().trim();
    check(!headings.some((text) => text === last || (last.length > 8 && text.endsWith(last))), `page ${i + 1} of ${pages.length} does not end with a heading: ${last}`);
  });
  pages.forEach((page, i) => check(page.words.length > 10, `page ${i + 1} is not empty: ${page.words.length} words`));
}

/// Each number with a place is that of the JSON, to its digits.
async function checkNumbers(file) {
  const json = JSON.parse(readFileSync(file, 'utf8'));
  const cells = await chromium.evaluate(`[...document.querySelectorAll('[data-json]')].map((e) => [e.dataset.json, e.textContent])`);
  const wrong = [];
  let numbers = 0;
  for (const [place, text] of cells) {
    const value = place.slice(1).split('/').reduce((own, key) => own?.[key], json);
    if (typeof value !== 'number') {
      const shown = value === true ? 'yes' : value === false ? 'no' : value;
      if (shown === undefined || !text.startsWith(shown)) wrong.push(`${place}: ${text}, in the JSON ${value}`);
      continue;
    }
    ++numbers;
    const [shown] = text.match(/^[-+]?[\d.]+(e[-+]?\d+)?/) || [''];
    const [mantissa, exponent] = shown.split('e');
    const digit = 10 ** (Number(exponent || 0) - (mantissa.split('.')[1] || '').length);
    const isRounded = mantissa.includes('.') || Math.abs(value) < 1e6;
    if (shown === '' || (isRounded && Math.abs(Number(shown) - value) > 0.5001 * digit)) wrong.push(`${place}: ${text}, in the JSON ${value}`);
  }
  check(numbers > 10 && wrong.length === 0, `${numbers} numbers are those of the JSON: ${wrong.join('; ')}`);
}

try {
  await chromium.open();
  await load();
  check(await chromium.evaluate('document.scripts.length === 0'), 'the page has no script');
  const odd = await chromium.evaluate(`(document.body.textContent.match(/.{0,30}(undefined|NaN|Infinity|\\bnull\\b).{0,20}/) || [''])[0]`);
  check(odd === '', `no word that a person is not to see: ${odd}`);
  check(await chromium.evaluate('document.documentElement.scrollWidth <= innerWidth'), 'the page is not wider than the window');
  check(await chromium.evaluate(`document.images.length === 0 && document.querySelectorAll('svg, iframe, object').length === 0`), 'no element but text and tables');
  const blanks = await chromium.evaluate(`document.querySelectorAll('.blank').length`);
  check(blanks > 2, `${blanks} lines are to be filled in by hand`);
  const shows = option('--shows');
  if (shows) check((await chromium.evaluate('document.body.textContent')).includes(shows), `the page shows ${shows}`);
  if (option('--json')) await checkNumbers(option('--json'));
  const folder = option('--keep') || mkdtempSync(join(tmpdir(), 'rollrig-report-'));
  try {
    const { data } = await chromium.send('Page.printToPDF', { printBackground: true, preferCSSPageSize: true });
    const pdf = join(folder, 'report.pdf');
    writeFileSync(pdf, Buffer.from(data, 'base64'));
    const pages = readPages(pdf);
    check(pages.every((page) => Math.abs(page.size[0] - kA4_pt[0]) < 2 && Math.abs(page.size[1] - kA4_pt[1]) < 2), `${pages.length} pages of A4`);
    await checkText(pages);
    await checkHeadings(pages);
  } finally {
    if (!option('--keep')) rmSync(folder, { recursive: true });
  }
  const strange = requests.filter((url) => url !== pathToFileURL(resolve(args[0])).href);
  check(strange.length === 0, `nothing but the file itself is asked for: ${strange.join(' ')}`);
  check(messages.length === 0, `no message of the browser: ${messages.join(' | ')}`);
} catch (error) {
  check(false, `the check itself: ${error.stack}`);
} finally {
  await chromium.close();
}
process.exit(problems.length === 0 ? 0 : 1);
