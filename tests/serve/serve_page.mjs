// The page of rollrig serve in headless Chromium, moved with events of mouse and keyboard as a person makes them.
import { spawn } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { Chromium } from '../report/chromium.mjs';

export const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/// Starts `rollrig serve`. Returns the address, and what ends it.
export function startServer(program, options, folder) {
  const server = spawn(program, ['serve', ...options], { cwd: folder, stdio: ['ignore', 'pipe', 'inherit'] });
  return new Promise((resolve, reject) => {
    let text = '';
    server.stdout.on('data', (data) => {
      text += data;
      const [address] = /http:\S+token=[0-9a-f]+/.exec(text) || [];
      if (address) resolve({ address, end: () => new Promise((done) => server.once('exit', done) && server.kill('SIGTERM')) });
    });
    server.on('exit', (code) => reject(new Error(`rollrig serve has ended: ${code}\n${text}`)));
  });
}

export class ServePage {
  constructor(width = 1400, height = 900) {
    [this.width, this.height] = [width, height];
    this.messages = [];
    this.requests = [];
  }

  async open(address) {
    this.chromium = new Chromium(undefined, this.width, this.height);
    this.chromium.on((method, params) => {
      if (method === 'Runtime.exceptionThrown') this.messages.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
      if (method === 'Log.entryAdded') this.messages.push(params.entry.text);
      if (method === 'Runtime.consoleAPICalled') this.messages.push(params.args.map((a) => a.value ?? a.description).join(' '));
      if (method === 'Network.requestWillBeSent') this.requests.push(params.request.url);
    });
    await this.chromium.open();
    await this.setSize(this.width, this.height);
    await this.chromium.send('Page.navigate', { url: address });
    await this.until("document.documentElement?.dataset.ready === 'yes' && document.querySelector('.times')");
    await this.evaluate("document.querySelector('.times').scrollIntoView()"); // charts are drawn near the window
    await this.until("document.querySelectorAll('.times svg path').length > 5");
    await this.evaluate('window.scrollTo(0, 0)');
  }

  setSize(width, height) {
    return this.chromium.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
  }

  evaluate(expression) {
    return this.chromium.evaluate(expression);
  }

  async until(expression, patience_ms = 40000) {
    const end = Date.now() + patience_ms;
    while (!(await this.evaluate(`Boolean(${expression})`))) {
      if (Date.now() > end) throw new Error(`not in time: ${expression}`);
      await wait(20);
    }
  }

  #mouse(type, x, y, more = {}) {
    return this.chromium.send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: type === 'mouseReleased' ? 0 : 1, clickCount: 1, ...more });
  }

  /// Middle of an element on the screen, where it is brought.
  async place(selector) {
    const box = await this.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); if (!e) return null;
      const inSight = (b) => b.top >= 60 && b.bottom <= innerHeight; if (!inSight(e.getBoundingClientRect())) e.scrollIntoView({ block: 'center' });
      const b = e.getBoundingClientRect(); return { x: b.x, y: b.y, width: b.width, height: b.height }; })()`);
    if (!box || !box.width) throw new Error(`cannot be seen: ${selector}`);
    return box;
  }

  async click(selector) {
    const box = await this.place(selector);
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await this.#mouse('mouseMoved', x, y, { buttons: 0, button: 'none' });
    await this.#mouse('mousePressed', x, y);
    await this.#mouse('mouseReleased', x, y);
  }

  /// Takes the knob of a slider and moves it over shares of its length; `between_ms` after each step.
  async drag(selector, shares, between_ms) {
    const box = await this.place(selector);
    const knob = 16;
    const at = (share) => box.x + knob / 2 + share * (box.width - knob);
    const y = box.y + box.height / 2;
    const now = await this.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); return (e.value - e.min) / (e.max - e.min); })()`);
    await this.#mouse('mousePressed', at(now), y);
    for (const share of shares) {
      await this.#mouse('mouseMoved', at(share), y);
      await wait(between_ms);
    }
    await this.#mouse('mouseReleased', at(shares.at(-1)), y);
  }

  /// Replaces what stands in a field, and presses Enter.
  async type(selector, text) {
    await this.click(selector);
    await this.evaluate(`document.querySelector(${JSON.stringify(selector)}).select()`);
    await this.chromium.send('Input.insertText', { text });
    for (const type of ['rawKeyDown', 'char', 'keyUp']) await this.chromium.send('Input.dispatchKeyEvent', { type, key: 'Enter', code: 'Enter', windowsVirtualKeyCode: 13, ...(type === 'char' ? { text: '\r' } : {}) });
  }

  /// Chooses an option as the keyboard does it; a list that opens is drawn by the system, outside of the page.
  async choose(selector, value) {
    await this.place(selector);
    await this.evaluate(`(() => { const e = document.querySelector(${JSON.stringify(selector)}); e.value = ${JSON.stringify(value)};
      if (e.value !== ${JSON.stringify(value)}) throw new Error('no such option: ${value}'); e.dispatchEvent(new Event('change', { bubbles: true })); })()`);
  }

  /// Drops files or a folder on the middle of the page.
  async drop(paths) {
    const at = { x: this.width / 2, y: this.height / 2, data: { items: [], files: paths, dragOperationsMask: 1 } };
    for (const type of ['dragEnter', 'dragOver', 'drop']) await this.chromium.send('Input.dispatchDragEvent', { type, ...at });
  }

  async screenshot(folder, name, whole = false) {
    if (!folder) return;
    const { data } = await this.chromium.send('Page.captureScreenshot', { captureBeyondViewport: whole });
    writeFileSync(join(folder, `${name}.png`), Buffer.from(data, 'base64'));
  }

  close() {
    return this.chromium.close();
  }
}

/// The value below which this share of the values lies.
export function quantile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  return sorted[Math.min(sorted.length - 1, Math.ceil(share * sorted.length) - 1)];
}
