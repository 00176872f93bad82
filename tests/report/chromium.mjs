// A headless Chromium, spoken to over a pipe in the DevTools protocol: enough of it for the checks of a page.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const kPatience_ms = 5000;

export class Chromium {
  constructor(program = process.env.CHROMIUM || 'chromium', width = 1280, height = 900) {
    this.profile = mkdtempSync(join(tmpdir(), 'rollrig-page-'));
    this.process = spawn(program, ['--headless', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--remote-debugging-pipe',
      '--no-first-run', '--disable-background-networking', '--disable-background-timer-throttling', '--disable-renderer-backgrounding',
      '--disable-backgrounding-occluded-windows', `--user-data-dir=${this.profile}`, `--window-size=${width},${height}`, 'about:blank'],
    { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.waiting = new Map();
    this.listeners = [];
    this.next = 1;
    this.rest = '';
    this.process.stdio[4].on('data', (data) => this.#read(data.toString()));
    this.process.on('error', (error) => this.#fail(error));
    this.process.on('exit', (code, signal) => this.#fail(new Error(`Chromium has ended: ${signal || code}`)));
    this.process.stdio[3].on('error', (error) => this.#fail(error));
  }

  #fail(error) {
    this.ended = error;
    this.waiting.forEach(({ reject }) => reject(error));
    this.waiting.clear();
  }

  #read(text) {
    const messages = (this.rest + text).split('\0');
    this.rest = messages.pop();
    for (const message of messages.map((one) => JSON.parse(one))) {
      const waiting = this.waiting.get(message.id);
      this.waiting.delete(message.id);
      if (!waiting) this.listeners.forEach((listener) => listener(message.method, message.params));
      else if (message.error) waiting.reject(new Error(message.error.message));
      else waiting.resolve(message.result);
    }
  }

  send(method, params = {}, sessionId = this.session) {
    if (this.ended) return Promise.reject(this.ended);
    const id = this.next++;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: sessionId || undefined })}\0`);
    return new Promise((resolve, reject) => this.waiting.set(id, { resolve, reject }));
  }

  /// Hears what the browser says. Returns what ends that.
  on(listener) {
    this.listeners.push(listener);
    return () => this.listeners.splice(this.listeners.indexOf(listener), 1);
  }

  /// Attaches to the one page.
  async open() {
    const { targetInfos } = await this.send('Target.getTargets');
    const page = targetInfos.find((target) => target.type === 'page');
    this.session = (await this.send('Target.attachToTarget', { targetId: page.targetId, flatten: true })).sessionId;
    await Promise.all(['Page', 'Runtime', 'Log', 'Network'].map((domain) => this.send(`${domain}.enable`)));
  }

  /// Another, empty tab beside it: what send() and evaluate() take to reach it. Its events are not heard.
  async openTab() {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank', background: true }, null);
    return (await this.send('Target.attachToTarget', { targetId, flatten: true }, null)).sessionId;
  }

  /// Value of an expression, a promise's result too.
  async evaluate(expression, sessionId = this.session) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, awaitPromise: true, returnByValue: true }, sessionId);
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  }

  /// Ends the browser in order, by force where it does not, and takes its profile away. A helper process of the browser may
  /// still write into the profile then: what cannot be taken away is left to the system's own cleaning.
  async close() {
    this.process.removeAllListeners('exit');
    if (this.process.exitCode === null && this.process.signalCode === null) {
      const ended = new Promise((resolve) => this.process.once('exit', resolve));
      const force = setTimeout(() => this.process.kill('SIGKILL'), kPatience_ms);
      this.process.stdio[3].write(`${JSON.stringify({ id: this.next++, method: 'Browser.close' })}\0`);
      await ended;
      clearTimeout(force);
    }
    try {
      rmSync(this.profile, { recursive: true, force: true, maxRetries: 10, retryDelay: 50 });
    } catch (error) {
      console.log(`left behind: ${error.message}`);
    }
  }
}
