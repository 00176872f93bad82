// Tire, test, its settings and the effects: what the next run is made from.
import { h } from '../dom.js';
import { capitalized, Slider } from './slider.js';

/// Settings that stand above all others; those that a test does not have are left out.
const kFirst = ['pressure_kPa', 'load_N', 'speed_km_h', 'ambient_degC'];

const shellWord = (text) => (/^[\w./:=+,@%-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);

export class Controls {
  constructor(choices, onChange) {
    this.choices = choices;
    this.onChange = onChange;
    this.sliders = new Map(); // by key, of the scenario that is chosen
    this.words = new Map();
    this.chosen = { scenario: 'iso_28580', tire: choices.tires.some((t) => t.name === 'a50') ? 'a50' : choices.tires[0].name, rig: '', vehicle: '' };
    this.settings = h('div');
    this.more = h('div');
    this.effects = h('div', { class: 'effects' });
    this.problem = h('div', { class: 'beside' });
    this.command = h('code');
    this.element = h('form', { class: 'controls', 'aria-label': 'Controls', onsubmit: (event) => event.preventDefault() },
      this.#makeChoices(), this.settings, this.problem,
      h('details', { class: 'group' }, h('summary', null, 'More settings'), this.more),
      h('details', { class: 'group', open: false }, h('summary', null, 'Effects'), this.effects),
      h('details', { class: 'group' }, h('summary', null, 'This run on the command line'), h('pre', { tabindex: '0' }, this.command)));
    this.#makeEffects();
    this.#chooseScenario();
  }

  #select(id, label, items, value, onChange) {
    const select = h('select', { id, onchange: () => onChange(select.value) },
      items.map((item) => h('option', { value: item.name, title: item.title, selected: item.name === value }, item.note ? `${item.name} \u2013 ${item.note}` : item.name || item.label)));
    return h('div', { class: 'choice' }, h('label', { for: id }, label), select);
  }

  #makeChoices() {
    const { choices, chosen } = this;
    this.rigs = h('div');
    const take = (key) => (value) => {
      chosen[key] = value;
      if (key === 'scenario') this.#chooseScenario();
      this.#changed();
    };
    return h('div', { class: 'choices' },
      this.#select('tire', 'Tire', choices.tires, chosen.tire, take('tire')),
      this.#select('scenario', 'Test', choices.scenarios.map(({ name, summary }) => ({ name, title: summary })), chosen.scenario, take('scenario')),
      this.rigs);
  }

  scenario() {
    return this.choices.scenarios.find((one) => one.name === this.chosen.scenario);
  }

  #chooseScenario() {
    const scenario = this.scenario();
    const take = (key) => (value) => {
      this.chosen[key] = value;
      this.#changed();
    };
    Object.assign(this.chosen, { rig: scenario.rig, vehicle: '' });
    const named = (names) => names.map((name) => ({ name }));
    this.rigs.replaceChildren(...[
      scenario.rigs.length > 1 && this.#select('rig', 'Rig', named(scenario.rigs), scenario.rig, take('rig')),
      scenario.has_vehicle && this.#select('vehicle', 'Vehicle', [{ name: '', label: 'that of the test' }, ...this.choices.vehicles], '', take('vehicle')),
    ].filter(Boolean));
    const kept = new Map([...this.sliders].filter(([, slider]) => slider.value !== null && kFirst.includes(slider.info.key)).map(([key, slider]) => [key, slider.value]));
    this.sliders.clear();
    this.words.clear();
    for (const info of scenario.settings) if (!info.choices) this.#addSlider(info, kept);
    for (const info of scenario.settings) if (info.choices) this.#addWord(info);
    const rank = (key) => kFirst.indexOf(key);
    const first = [...this.sliders.keys()].filter((key) => rank(key) >= 0).sort((a, b) => rank(a) - rank(b));
    this.settings.replaceChildren(...first.map((key) => this.sliders.get(key).element));
    this.more.replaceChildren(...[...this.sliders].filter(([key]) => rank(key) < 0).map(([, slider]) => slider.element), ...[...this.words.values()].map((word) => word.element));
  }

  #addSlider(info, kept) {
    const slider = new Slider(info, { id: `setting-${info.key}`, onInput: () => this.#changed() });
    if (kept.has(info.key)) slider.value = kept.get(info.key);
    this.sliders.set(info.key, slider);
  }

  #addWord(info) {
    const word = { value: null };
    word.element = this.#select(`setting-${info.key}`, capitalized(info.label), info.choices.map((name) => ({ name })), info.fallback, (value) => {
      word.value = value === info.fallback ? null : value;
      this.#changed();
    });
    this.words.set(info.key, word);
  }

  #makeEffects() {
    this.effectRows = this.choices.effects.map((effect) => {
      const box = h('input', { type: 'checkbox', id: `effect-${effect.id}` });
      const sliders = effect.parameters.map((info) => new Slider(info, { id: `effect-${effect.id}-${info.key}`, onInput: () => this.#changed() }));
      const inside = h('div', { class: 'inside', hidden: true }, sliders.map((slider) => slider.element));
      const row = { effect, box, sliders, element: h('div', { class: 'effect' }, h('label', { title: effect.summary }, box, ' ', capitalized(effect.label)), inside) };
      sliders.forEach((slider, i) => slider.setUsed(effect.parameters[i].center));
      box.addEventListener('change', () => {
        inside.hidden = !box.checked;
        this.#changed();
      });
      return row;
    });
    this.effects.replaceChildren(h('p', { class: 'note' }, 'An effect that is on begins at its usual size.'), ...this.effectRows.map((row) => row.element));
  }

  #changed() {
    this.#showCommand();
    this.onChange();
  }

  /// The request of a run.
  request() {
    const settings = {};
    for (const [key, slider] of this.sliders) if (slider.value !== null) settings[key] = slider.value;
    for (const [key, word] of this.words) if (word.value !== null) settings[key] = word.value;
    const effects = {};
    for (const { effect, box, sliders } of this.effectRows) {
      if (!box.checked) continue;
      effects[effect.id] = Object.fromEntries(sliders.map((slider) => [slider.info.key, slider.value ?? slider.fallback]));
    }
    return { ...this.chosen, settings, effects };
  }

  #showCommand() {
    const { scenario, tire, rig, vehicle, settings, effects } = this.request();
    const words = ['rollrig', 'run', scenario, '--tire', tire, '--fidelity', 'quasi_static'];
    if (rig && rig !== this.scenario().rig) words.push('--rig', rig);
    if (vehicle) words.push('--vehicle', vehicle);
    for (const [key, value] of Object.entries(settings)) words.push('--set', `${key}=${value}`);
    for (const [id, parameters] of Object.entries(effects)) for (const [key, value] of Object.entries(parameters)) words.push('--set', `effects.${id}.${key}=${value}`);
    this.command.textContent = words.map(shellWord).join(' ');
  }

  /// What the run used: defaults of sliders, effects that act.
  showUsed({ settings, effects }) {
    for (const [key, slider] of this.sliders) slider.setUsed(settings[key]);
    for (const { effect, box, element } of this.effectRows) {
      const acts = effects.includes(effect.id);
      element.classList.toggle('idle', !acts);
      element.querySelector('label').title = acts ? effect.summary : `${effect.summary}. Changes nothing on this machine with this tire.`;
      box.setAttribute('aria-description', acts ? '' : 'changes nothing on this machine');
    }
    this.setProblem(null);
    this.#showCommand();
  }

  /// A problem stands beside the control that it names, else below all of them.
  setProblem(problem) {
    const named = [...this.sliders.values()].map((slider) => [`[settings] ${slider.info.key}`, slider]).concat(
      this.effectRows.flatMap((row) => row.sliders.map((slider) => [`[effects.${row.effect.id}] ${slider.info.key}`, slider])));
    const at = problem && named.find(([name, slider]) => name === problem.key || (slider.info.key === problem.key && slider.value !== null))?.[1];
    named.forEach(([, slider]) => slider.setProblem(slider === at ? problem : null));
    this.otherProblem = problem && !at ? problem : null;
    return this.otherProblem;
  }
}
