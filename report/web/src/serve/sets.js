// From a dropped folder to a diagnosis: files, columns, validation, progress, result.
import { h } from '../dom.js';
import { clockTime } from '../format.js';
import { get, keptAddress, post, ProblemError, upload } from './api.js';
import { bytesText, makeColumns, makeGuesses } from './columns.js';
import { readChosen } from './drop.js';
import { makeNumberField } from './number_field.js';
import { makeProblem } from './problem.js';
import { Results } from './results.js';
import { capitalized } from './slider.js';

const kBetweenLooks_ms = 300;
const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

const kWords = {
  set: 'A measurement set, as its set.toml describes it.',
  mapping: 'Logs with a mapping (import.toml), by which they are joined.',
  logs: 'Logs without a description. Say which tire and which rig, and check the columns.',
};

export class Sets {
  constructor(choices) {
    this.choices = choices;
    this.results = new Results({ id: 'diagnosis', keepsOrder: true });
    this.steps = h('div', { class: 'steps' });
    const chooser = h('input', { type: 'file', id: 'folder', webkitdirectory: true, multiple: true, class: 'hiddenfile', onchange: () => this.take(readChosen(chooser.files)) });
    this.zone = h('div', { class: 'dropzone' }, h('p', null, 'Drop a folder of CSV files here, or anywhere on this page.'),
      h('p', { class: 'note' }, 'One log for each run, or a measurement set with its set.toml. Tire and rig files (.toml) may lie beside them. Files go to rollrig on this computer and nowhere else.'),
      h('label', { for: 'folder', class: 'tool' }, 'Choose a folder'), chooser);
    this.jobs = h('div', { class: 'jobs' });
    this.element = h('div', { class: 'setbench' }, this.zone, this.steps, this.jobs, this.results.element);
  }

  /// Shows the jobs that the server has, such as those from before the page was loaded again: those that run or wait with
  /// their progress, those that are done with a link to their page, the result of the last one too. Returns whether one
  /// runs or waits.
  async resume() {
    const { jobs } = await get('/api/jobs');
    const open = jobs.filter(({ state }) => state === 'running' || state === 'waiting');
    for (const { job, name, kept } of jobs) {
      if (kept) this.#addJob(job).replaceChildren(this.#makeKept(name, kept));
    }
    const last = jobs.at(-1);
    if (last?.kept) this.results.show((await get(`/api/jobs/${last.job}`)).result.page);
    for (const { job, name } of open) this.#follow(job, name).catch((error) => this.#fail(error, this.#addJob(job)));
    return open.length > 0;
  }

  /// Where a job is shown, the newest first.
  #addJob(job) {
    const known = this.jobs.querySelector(`[data-job="${job}"]`);
    if (known) return known;
    const holder = h('div', { class: 'job', 'data-job': job });
    this.jobs.prepend(holder);
    return holder;
  }

  #makeKept(name, kept) {
    return h('p', { class: 'kept' }, `Diagnosis of ${name}, kept: `, h('a', { href: keptAddress(kept), target: '_blank', rel: 'noopener' }, kept), ` in ${this.choices.keep_folder}/`);
  }

  #step(title, ...content) {
    const step = h('section', { class: 'step' }, h('h2', null, title), content);
    return step;
  }

  #fail(error, holder) {
    if (!(error instanceof ProblemError)) throw error;
    holder.replaceChildren(makeProblem(error.problem));
  }

  /// Files that were dropped: {name, files: [{name, file}]}.
  async take({ name, files }) {
    this.results.clear();
    const { limits, endings } = this.choices;
    const wanted = files.filter((one) => endings.some((ending) => one.name.toLowerCase().endsWith(ending)) && !one.name.split('/').some((part) => part.startsWith('.')));
    const size = wanted.reduce((sum, one) => sum + one.file.size, 0);
    this.state = h('p', { role: 'status' });
    const problem = h('div');
    this.steps.replaceChildren(this.#step('Files', this.state, problem));
    try {
      if (!wanted.length) throw new ProblemError({ what: 'there is no file that rollrig reads among what was dropped', allowed: endings.join(', ') });
      if (size > limits.set_bytes || wanted.length > limits.files) throw new ProblemError({ what: `at most ${limits.files} files of ${bytesText(limits.set_bytes)} in all are taken` });
      const large = wanted.find((one) => one.file.size > limits.file_bytes);
      if (large) throw new ProblemError({ what: `a file of more than ${bytesText(limits.file_bytes)} is not taken`, file: large.name });
      const opened = await post('/api/sets', { name });
      [this.id, this.name] = [opened.set, opened.name];
      for (const [i, one] of wanted.entries()) {
        this.state.textContent = `${i + 1} of ${wanted.length}: ${one.name}`;
        await upload(`/api/sets/${this.id}/files?name=${encodeURIComponent(one.name)}`, one.file);
      }
      const left = files.length - wanted.length;
      this.state.textContent = `${wanted.length} ${wanted.length === 1 ? 'file' : 'files'}, ${bytesText(size)}${left ? `; ${left} of other kinds left out` : ''}.`;
      this.said = { tire: '', rig: '', columns: {}, units: {}, values: {}, rests_min: {} };
      await this.#look(true);
    } catch (error) {
      this.#fail(error, problem);
    }
  }

  /// Guesses again with what the person has said.
  async #look(isFirst) {
    const number = (this.looks = (this.looks || 0) + 1);
    if (isFirst) {
      const found = await post(`/api/sets/${this.id}/columns`, {});
      for (const kind of ['tire', 'rig']) this.said[kind] = found.files.find((file) => file.kind === kind)?.name || '';
      this.found = found;
    }
    if (this.found.kind === 'logs' && this.said.tire && this.said.rig) this.found = await post(`/api/sets/${this.id}/columns`, this.said);
    if (number === this.looks) this.#showLook();
  }

  #showLook() {
    const { found, said } = this;
    const again = () => this.#look(false).catch((error) => this.#fail(error, this.lookProblem));
    const select = (kind, label, items) => h('label', null, label, ' ', h('select', { id: `set-${kind}`, onchange: (event) => {
      said[kind] = event.target.value;
      again();
    } }, h('option', { value: '' }, 'choose'), found.files.filter((file) => file.kind === kind).map((file) => h('option', { value: file.name, selected: said[kind] === file.name }, `${file.name} (dropped)`)),
    items.map(({ name, note }) => h('option', { value: name, selected: said[kind] === name }, note ? `${name} \u2013 ${note}` : name))));
    this.lookProblem = h('div');
    const isLogs = found.kind === 'logs';
    const isReady = !isLogs || (!found.problem && found.columns);
    this.checked = h('div');
    this.confirm = h('button', { type: 'button', class: 'tool main', id: 'confirm', disabled: !isReady, onclick: () => this.#validate() }, isLogs ? 'These columns are right: make the set and validate it' : 'Validate the set');
    const step = this.#step(isLogs ? 'Columns' : 'Set', h('p', { class: 'note' }, kWords[found.kind]),
      isLogs && h('div', { class: 'pairs' }, select('tire', 'Tire', this.choices.tires), select('rig', 'Rig', this.choices.rigs)),
      isLogs && makeColumns(found, said, again), isLogs && this.#makeQuestions(again), this.lookProblem, isLogs && makeGuesses(found.guesses, found.targets), this.confirm, this.checked);
    if (found.problem) this.lookProblem.replaceChildren(makeProblem(found.problem));
    this.steps.replaceChildren(this.steps.firstChild, step);
  }

  /// What logs may not tell.
  #makeQuestions(again) {
    const { said } = this;
    const order = h('select', { id: 'date-order', onchange: () => {
      said.date_order = order.value;
      again();
    } }, ['', 'ymd', 'dmy', 'mdy'].map((one) => h('option', { value: one, selected: (said.date_order || '') === one }, one || 'as guessed')));
    const cold = makeNumberField({ id: 'cold', value: said.cold_pressure_kPa ?? '', mayBeEmpty: true, onNumber: (value) => {
      said.cold_pressure_kPa = value;
      again();
    } });
    const asked = this.found.problem?.rest_before;
    const rests = [...new Set([...Object.keys(said.rests_min), ...(asked ? [asked] : [])])].map((run) => [run, makeNumberField({ 'data-rest': run, value: said.rests_min[run] ?? '', mayBeEmpty: true, onNumber: (value) => {
      if (value === undefined) delete said.rests_min[run];
      else said.rests_min[run] = value;
      again();
    } })]);
    return h('div', { class: 'pairs' }, h('label', null, 'Order of dates ', order),
      h('div', null, h('label', null, 'Pressure of the cold tire ', cold.field, ' kPa'), cold.message),
      rests.map(([run, rest]) => h('div', null, h('label', null, `Rest before ${run} `, rest.field, ' min'), rest.message)));
  }

  async #validate() {
    this.confirm.disabled = true;
    this.checked.replaceChildren(h('p', { role: 'status', class: 'busy' }, 'The set is read and held against the simulation\u2026'));
    try {
      this.#showChecked(await post(`/api/sets/${this.id}/validate`, this.said));
    } catch (error) {
      this.#fail(error, this.checked);
    }
    this.confirm.disabled = false;
  }

  #showChecked({ what, warnings, is_good: isGood }) {
    this.run = h('button', { type: 'button', class: 'tool main', id: 'diagnose', onclick: () => this.#diagnose() }, 'Diagnose');
    this.problem = h('div');
    this.only = this.choices.effects.map(({ id, label }) => ({ id, box: h('input', { type: 'checkbox', id: `only-${id}` }), label }));
    const only = h('details', { class: 'group' }, h('summary', null, 'Compare only some effects'), h('p', { class: 'note' }, 'Without a choice all effects are compared, as they should be unless you know better.'),
      h('div', { class: 'only' }, this.only.map(({ box, label }) => h('label', null, box, ' ', capitalized(label)))));
    this.checked.replaceChildren(h('div', { class: `lead ${isGood ? (warnings.length ? 'doubt' : 'good') : 'bad'}` }, h('div', null, h('p', null, `Validated: ${what}`))),
      h('ul', { class: 'warnings' }, warnings.map((warning) => h('li', null, h('strong', null, 'warning: '), warning))), only, this.run, this.problem);
    this.checked.scrollIntoView({ block: 'nearest' });
  }

  async #diagnose() {
    const { run, problem } = this;
    run.disabled = true;
    problem.replaceChildren();
    this.results.clear();
    try {
      const { job } = await post(`/api/sets/${this.id}/diagnose`, { only: Object.fromEntries(this.only.filter(({ box }) => box.checked).map(({ id }) => [id, true])) });
      await this.#follow(job, this.name);
    } catch (error) {
      this.#fail(error, problem);
    }
    run.disabled = false;
  }

  async #follow(job, name) {
    const holder = this.#addJob(job);
    const bar = h('progress', { max: 1, 'aria-label': `Progress of the diagnosis of ${name}` });
    const text = h('span', { role: 'status' });
    const cancel = h('button', { type: 'button', class: 'tool cancel', onclick: () => post(`/api/jobs/${job}/cancel`) }, 'Cancel');
    holder.replaceChildren(h('div', { class: 'progress' }, h('span', null, `Diagnosis of ${name}`), bar, text, cancel));
    let start = null; // of this part of the work, as far as the page has seen it
    let last = 0;
    for (;;) {
      const now = await get(`/api/jobs/${job}`);
      if (now.state === 'done') return this.#showDiagnosis(holder, name, now.result);
      if (now.state === 'failed') return holder.replaceChildren(h('p', null, `Diagnosis of ${name}:`), makeProblem(now.error));
      if (now.state === 'canceled') return holder.replaceChildren(h('p', null, `Diagnosis of ${name}: canceled. Nothing was kept.`));
      if (!start || !(now.done >= last)) start = { ms: performance.now(), done: now.done ?? 0 }; // more work may turn out to follow
      last = now.done ?? 0;
      const elapsed_s = (performance.now() - start.ms) / 1000;
      const gained = last - start.done;
      if (now.state === 'running' && now.done > 0) bar.value = now.done;
      const left = gained > 0.02 && elapsed_s > 2 ? `, about ${clockTime((elapsed_s * (1 - last)) / gained)} left` : '';
      text.textContent = now.state === 'waiting' ? 'waits for another diagnosis' : `${Math.round(100 * (now.done ?? 0))} %${left}  ${now.stage}`;
      await wait(kBetweenLooks_ms);
    }
  }

  #showDiagnosis(holder, name, { page, kept }) {
    holder.replaceChildren(this.#makeKept(name, kept));
    this.results.show(page);
    this.results.element.scrollIntoView({ block: 'start' });
  }
}
