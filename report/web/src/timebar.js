// The slider of the page's time with what every channel shows at it. {phases, speeds}
import { h } from './dom.js';
import { clockTime } from './format.js';

const kSpeeds = [1, 10, 60, 300, 1200]; // seconds of the test a second

/// Moves the clock on while it plays; stops at the end and when the page is hidden.
function makePlayer(clock, button) {
  let speed = 60;
  let last = null;
  const step = (now_ms) => {
    if (last === null) return;
    clock.set(clock.now_s + ((now_ms - last) / 1000) * speed);
    last = now_ms;
    if (clock.now_s >= clock.end_s) stop();
    else requestAnimationFrame(step);
  };
  const stop = () => {
    last = null;
    button.textContent = '\u25b6\ufe0e Play';
  };
  const play = () => {
    if (clock.now_s >= clock.end_s) clock.set(clock.start_s);
    last = performance.now();
    button.textContent = '\u275a\u275a Pause';
    requestAnimationFrame(step);
  };
  button.addEventListener('click', () => (last === null ? play() : stop()));
  document.addEventListener('visibilitychange', () => document.hidden && stop());
  return (value) => (speed = value);
}

export function timeBarBlock({ phases = [] }, { clock }) {
  const phaseAt = (t) => phases.find((p) => t >= p.start_s && t < p.end_s) || phases.at(-1);
  const slider = h('input', { type: 'range', id: 'time', min: clock.start_s, max: clock.end_s, step: 1, 'aria-label': 'Time of the test' });
  const output = h('output', { for: 'time', class: 'now' });
  const button = h('button', { type: 'button', class: 'tool play' }, '\u25b6\ufe0e Play');
  const setSpeed = makePlayer(clock, button);
  const select = h('select', { 'aria-label': 'Speed of the animation', onchange: (event) => setSpeed(Number(event.target.value)) },
    kSpeeds.map((speed) => h('option', { value: speed, selected: speed === 60 }, `${speed}\u00d7`)));
  slider.addEventListener('input', () => clock.set(Number(slider.value)));
  slider.addEventListener('keydown', (event) => {
    const steps = { PageUp: 60, PageDown: -60 }[event.key];
    if (!steps) return;
    event.preventDefault();
    clock.set(clock.now_s + steps);
  });
  clock.onChange((t) => {
    const phase = phaseAt(t);
    slider.value = t;
    slider.setAttribute('aria-valuetext', `${clockTime(t)}${phase ? `, ${phase.name}` : ''}`);
    output.textContent = `${clockTime(t)}${phase ? ` \u00b7 ${phase.name}` : ''}`;
  });
  return h('div', { class: 'timebar', role: 'group', 'aria-label': 'Time' }, button, select, slider, output);
}
