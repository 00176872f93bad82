// Light, dark, or as the system says; on paper always light.
import { h } from './dom.js';

const listeners = [];
let onPaper = false;
const root = document.documentElement;

const choices = ['auto', 'light', 'dark'];
let chosen = 'auto';

function apply() {
  const dark = matchMedia('(prefers-color-scheme: dark)').matches;
  const theme = onPaper ? 'light' : chosen === 'auto' ? (dark ? 'dark' : 'light') : chosen;
  if (root.dataset.theme === theme) return;
  root.dataset.theme = theme;
  listeners.forEach((listener) => listener());
}

/// Returns what ends that.
export function onThemeChange(listener) {
  listeners.push(listener);
  return () => listeners.splice(listeners.indexOf(listener), 1);
}

/// A color of style.css.
export const color = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();

/// Line colors with their dashes and hatches, told apart in black and white too.
export function seriesStyle(i) {
  const dashes = ['solid', [7, 4], [2, 3], [9, 3, 2, 3], [12, 3]]; // five: with six colors, 30 lines are told apart
  return { color: color(`series-${(i % 6) + 1}`), type: dashes[i % dashes.length] };
}

/// Whether the page is being laid out for print.
export const isOnPaper = () => onPaper;

const paperListeners = [];

/// Calls a listener with whether the page is laid out for print, when that changes and before it is drawn.
export const onPaperChange = (listener) => paperListeners.push(listener);

export function setOnPaper(value) {
  onPaper = value;
  apply();
  paperListeners.forEach((listener) => listener(value));
}

export function startTheme() {
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', apply);
  apply();
}

export function makeThemeButton() {
  const words = { auto: 'Theme: system', light: 'Theme: light', dark: 'Theme: dark' };
  const button = h('button', { type: 'button', class: 'tool' }, words[chosen]);
  button.addEventListener('click', () => {
    chosen = choices[(choices.indexOf(chosen) + 1) % choices.length];
    button.textContent = words[chosen];
    apply();
  });
  return button;
}
