// Uses the page of rollrig serve in headless Chromium: sliders, wrong numbers, effects, another test, a dropped folder up
// to its diagnosis. One line a finding; exit status 1 where one is bad.
// node check_serve.mjs <rollrig> <folder for files> <folder to drop> [--screenshots DIR]
import { mkdirSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { kFindProblems } from '../report/find_problems.mjs';
import { quantile, ServePage, startServer, wait } from './serve_page.mjs';

const [program, folder, dropped] = process.argv.slice(2);
const shots = process.argv.includes('--screenshots') ? process.argv[process.argv.indexOf('--screenshots') + 1] : null;
if (shots) mkdirSync(shots, { recursive: true });
// Tests run side by side, on machines that do other work, and the latency is a figure of the page: the quickest of some
// positions finds a page that waits for something. bench/serve_latency.mjs measures.
const kMostLatency_ms = 1000;
const problems = [];
const check = (isGood, text) => {
  console.log(`${isGood ? 'ok' : 'BAD'}  ${text}`);
  if (!isGood) problems.push(text);
};

const server = await startServer(program, ['--keep', 'kept'], folder);
const page = new ServePage();

/// The page's rolling resistance coefficient.
const kRrc = `Number([...document.querySelectorAll('.lines tr')].find((row) => row.firstChild.textContent === 'RRc').lastChild.textContent.split(' ')[0])`;
const kCurves = `[...document.querySelectorAll('.times svg path')].map((path) => path.getAttribute('d')).join()`;
const settled = () => page.until("!document.querySelector('.status').classList.contains('busy')");

/// Texts, legends and plots stay apart in every width, light and dark.
/// On paper the controls are left out, and charts are as wide as the sheet.
async function checkPaper() {
  await page.evaluate("(dispatchEvent(new Event('beforeprint')), 0)");
  const widths = await page.evaluate("[document.querySelector('.bench main').clientWidth, ...[...document.querySelectorAll('.bench main .times.part svg')].map((svg) => svg.clientWidth)]");
  check(widths.length > 1 && Math.min(...widths) > 600, `charts are as wide as a sheet on paper: ${widths.join(', ')} px`);
  check(await page.evaluate("getComputedStyle(document.querySelector('.bench > aside')).display === 'none'"), 'no controls on paper');
  await page.evaluate("(dispatchEvent(new Event('afterprint')), 0)");
}

async function checkBoxes(what) {
  const found = new Set();
  for (const theme of ['light', 'dark']) {
    await page.chromium.send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: theme }] });
    for (const width of [1400, 768, 420]) {
      await page.setSize(width, 900);
      await page.until(`innerWidth === ${width}`);
      await wait(200);
      await page.evaluate('(rollrig.drawAll(), 0)');
      for (const problem of await page.evaluate(kFindProblems)) found.add(`${theme}, ${width} px: ${problem}`);
      await page.screenshot(shots, `${what.replaceAll(' ', '_')}_${theme}_${width}`, true);
    }
  }
  await page.setSize(1400, 900);
  check(found.size === 0, `${what}: boxes stay apart ${[...found].join('; ')}`);
}

async function checkSliders() {
  const before = { rrc: await page.evaluate(kRrc), curves: await page.evaluate(kCurves), now: await page.evaluate("document.querySelector('.readings').textContent") };
  await page.drag('#setting-pressure_kPa', Array.from({ length: 20 }, (_, i) => 0.5 - 0.02 * i), 60);
  await settled();
  await wait(200);
  const pressure = await page.evaluate("document.querySelector('#setting-pressure_kPa').value");
  check(pressure < 200, `the slider was moved with the mouse: ${pressure} kPa`);
  check((await page.evaluate(kRrc)) > before.rrc, 'the RRc rises as the pressure falls');
  check((await page.evaluate(kCurves)) !== before.curves, 'the curves have changed');
  check((await page.evaluate("document.querySelector('.readings').textContent")) !== before.now, 'the readings beside the animation have changed');
  const latencies = await page.evaluate('window.rollrig.latencies');
  check(Math.min(...latencies) < kMostLatency_ms, `from the slider to the curves: ${Math.round(Math.min(...latencies))} ms at least, median ${Math.round(quantile(latencies, 0.5))} ms of ${latencies.length}`);
  await page.click('#setting-pressure_kPa ~ *, .control.moved .reset');
  await settled();
  await wait(200);
  check((await page.evaluate(kRrc)) === before.rrc, 'back to the default: the same RRc');
}

async function checkWrongNumber() {
  await page.type('#setting-pressure_kPa-field', '5');
  await page.until("document.querySelector('.control .problem')");
  const text = await page.evaluate("document.querySelector('#setting-pressure_kPa').closest('.control').querySelector('.problem').textContent");
  check(/>= 50 and <= 1000/.test(text), `a wrong number is said beside its control: ${text}`);
  await page.click('.control.moved .reset');
  await page.until("!document.querySelector('.problem')");
}

/// Fields that are empty or hold no number say so beside them, and nothing is asked of the server.
async function checkNoNumber() {
  const set = (field, text) => page.evaluate(`(() => { const e = document.querySelector('${field}'); e.value = '${text}'; e.dispatchEvent(new Event('change', { bubbles: true })); })()`);
  const beside = (field) => page.evaluate(`document.querySelector('${field}').closest('.control, .pairs > div').querySelector('.problem')?.textContent ?? ''`);
  const field = (await page.evaluate("Boolean(document.querySelector('#cold'))")) ? '#cold' : '#setting-pressure_kPa-field';
  await set(field, 'about 250');
  check(/no number.*about 250/.test(await beside(field)), `what is no number is refused beside ${field}: ${await beside(field)}`);
  await set(field, '');
  const empty = await beside(field);
  check(field === '#cold' ? empty === '' : /missing/.test(empty), `an empty ${field} is ${field === '#cold' ? 'as guessed' : 'refused beside it'}: ${empty}`);
}

async function checkEffectsAndTests() {
  const before = await page.evaluate(kRrc);
  await page.click('.controls .group:nth-of-type(2) > summary, details.group:has(.effects) > summary');
  await page.click('#effect-toe_camber_drag');
  await settled();
  await page.until(`${kRrc} !== ${before}`);
  check(true, 'an effect changes the RRc');
  await page.click('#effect-toe_camber_drag');
  await settled();
  await page.choose('#scenario', 'speed_sweep');
  await page.until("document.querySelector('h1').textContent.startsWith('RRc at several speeds')");
  check(true, 'another test is shown');
  await checkPaper();
  await page.choose('#scenario', 'iso_28580');
  await page.until(`document.querySelector('h1').textContent.startsWith('Whole ISO')`);
}

async function checkDrop() {
  await page.drop([dropped]);
  await page.until("document.querySelector('#confirm:enabled')");
  const shown = await page.evaluate("document.querySelector('.columnstable').textContent");
  check(/Geschwindigkeit/.test(shown), 'the columns of the logs are guessed and shown');
  await checkNoNumber();
  await page.until("document.querySelector('#confirm:enabled')");
  const told = await page.evaluate("document.querySelector('.setbench').textContent");
  const option = /.{0,40}(?<!-)--[a-z].{0,40}/.exec(told);
  check(!option, `no option of the command line is named: ${option ?? ''}`);
  await checkBoxes('columns of a dropped folder');
  await page.click('#confirm');
  await page.until("document.querySelector('#diagnose')");
  check(/Validated/.test(await page.evaluate("document.querySelector('.step:last-child').textContent")), 'the set is validated');
  await page.click('details.group:has(.only) > summary');
  for (const id of ['bearing_warmup', 'load_exponent']) await page.click(`#only-${id}`);
  await page.click('#diagnose');
  await page.until("document.querySelector('progress')");
  check(true, 'the diagnosis shows its progress');
  await page.evaluate('(window.isOld = true)');
  await page.chromium.send('Page.reload');
  await page.until("!window.isOld && document.documentElement?.dataset.ready === 'yes'");
  const again = await page.evaluate("document.querySelector('#view-sets:not([hidden]) .job:has(progress, .kept a)')?.textContent ?? ''");
  check(/^Diagnosis of my logs/.test(again), `after a reload the diagnosis is there again: ${again}`);
  await page.until("document.querySelector('.setbench .kept a')", 120000);
  const { href } = await page.evaluate("({ href: document.querySelector('.setbench .kept a').href })");
  check(readdirSync(join(folder, 'kept')).length === 1, 'the page is kept');
  check((await page.evaluate("document.querySelectorAll('.setbench main section').length")) > 3, 'the diagnosis is shown');
  await checkBoxes('diagnosis of a dropped folder');
  await page.evaluate(`window.scrollTo(0, 0)`);
  return href;
}

try {
  await page.open(server.address);
  await checkBoxes('controls and results');
  await checkSliders();
  await checkWrongNumber();
  await checkNoNumber();
  await page.type('#setting-pressure_kPa-field', '260');
  await settled();
  await page.click('.control.moved .reset');
  await settled();
  await checkEffectsAndTests();
  const kept = await checkDrop();
  const own = new URL(server.address).origin;
  const strange = page.requests.filter((url) => !url.startsWith(`${own}/`) && !/^(data|blob|about):/.test(url));
  check(strange.length === 0, `no request leaves the server ${strange.join(' ')}`);
  const unexpected = page.messages.filter((text) => !/status of 422/.test(text));  // that of the wrong number
  check(unexpected.length === 0, `nothing on the console ${unexpected.join('; ')}`);
  await page.chromium.send('Page.navigate', { url: kept });
  await page.until("document.documentElement?.dataset.ready === 'yes' && document.querySelectorAll('section').length > 3");
  check(true, 'the kept page opens from its address');
} catch (error) {
  check(false, error.stack);
  await page.screenshot(shots, 'failure', true);
}
await page.close();
await server.end();
process.exit(problems.length ? 1 : 0);
