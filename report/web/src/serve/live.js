// Runs that follow the controls: one at a time, and of those that wait the last.
import { h } from '../dom.js';
import { keptAddress, post } from './api.js';
import { Controls } from './controls.js';
import { makeProblem } from './problem.js';
import { Results } from './results.js';

/// From the last change by the person to its picture on the screen, in ms: for the check of latency.
export const latencies = [];

const kRest_ms = 200; // without a change, until what is out of sight is drawn as well

export class Live {
  constructor(choices) {
    this.results = new Results();
    this.status = h('p', { class: 'status', role: 'status' });
    this.message = h('div', { class: 'beside' });
    this.kept = h('p', { class: 'kept' });
    this.controls = new Controls(choices, () => this.#ask());
    const keep = h('button', { type: 'button', class: 'tool', onclick: () => this.#keep() }, 'Keep as a page');
    this.controls.element.append(h('div', { class: 'actions' }, keep), this.kept);
    this.element = h('div', { class: 'bench' }, h('aside', null, this.controls.element), h('div', { class: 'outcome' }, this.status, this.message, this.results.element));
    this.#ask();
  }

  #ask() {
    this.next = { request: this.controls.request(), changed_ms: performance.now() };
    if (!this.isBusy) this.#workOff();
  }

  async #workOff() {
    this.isBusy = true;
    try {
      await this.#answerAll();
    } finally {
      this.status.classList.remove('busy');
      this.isBusy = false;
    }
    clearTimeout(this.rest);
    this.rest = setTimeout(() => !this.isBusy && this.results.rest(), kRest_ms);
  }

  async #answerAll() {
    while (this.next) {
      const { request, changed_ms } = this.next;
      this.next = null;
      this.status.classList.add('busy');
      try {
        const answer = await post('/api/run', request);
        this.#show(answer, changed_ms);
      } catch (error) {
        if (!error.problem) throw error;
        if (!this.next) this.#showProblem(error.problem);
      }
      // The picture comes before the next question: else a slider that keeps moving would starve it.
      await new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve)));
    }
  }

  #show(answer, changed_ms) {
    this.results.show(answer.page);
    this.controls.showUsed(answer);
    this.message.replaceChildren();
    this.status.textContent = `Simulated in ${Math.round(answer.took_ms.run + answer.took_ms.page)} ms, quasi-static`;
    requestAnimationFrame(() => setTimeout(() => latencies.push(performance.now() - changed_ms)));
  }

  #showProblem(problem) {
    const other = this.controls.setProblem(problem);
    this.message.replaceChildren(...(other ? [makeProblem(other)] : []));
    this.status.textContent = 'The curves are those of the last run that succeeded.';
  }

  async #keep() {
    try {
      const { kept } = await post('/api/keep', this.controls.request());
      this.kept.replaceChildren('Kept: ', h('a', { href: keptAddress(kept), target: '_blank', rel: 'noopener' }, kept));
    } catch (error) {
      this.kept.replaceChildren(makeProblem(error.problem));
    }
  }
}
