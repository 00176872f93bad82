// Numbers and times as a person reads them.

const kMinus = '\u2212';

/// About four digits, no exponent where a person would not write one, a true minus sign.
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '\u2013';
  const size = Math.abs(value);
  if (size === 0) return '0';
  let text;
  if (size >= 1e6 || size < 1e-4) text = value.toExponential(Math.max(0, digits - 2));
  else text = value.toFixed(Math.min(7, Math.max(0, digits - 1 - Math.floor(Math.log10(size)))));
  if (/^-0(\.0*)?$/.test(text)) text = text.slice(1);
  return text.replace('-', kMinus);
}

/// A fixed number of decimals, for a column or an axis.
export const fixed = (value, decimals) =>
  Number.isFinite(value) ? value.toFixed(decimals).replace(/^-(0(\.0*)?)$/, '$1').replace('-', kMinus) : '\u2013';

/// A text with true minus signs before its numbers, \u00b1 for what a terminal writes as +-, and % kept to its number.
export const typeset = (text) => String(text).replace(/(^|[\s(])-(?=[\d.])/g, `$1${kMinus}`).replace(/(^| )\+- /g, '$1\u00b1 ').replace(/(\d) %/g, '$1\u00a0%');

/// Decimals with which a range of values is told apart, for readouts that do not jump.
export function decimalsFor(low, high) {
  const span = Math.max(Math.abs(low), Math.abs(high));
  if (!(span > 0)) return 0;
  return Math.min(6, Math.max(0, 4 - Math.ceil(Math.log10(span) + 1e-9)));
}

/// The most decimals, not above `most` and at most two fewer, with which parts as they are shown have the sum as it is
/// shown; `most` where there are none.
export function decimalsThatAddUp(parts, sum, most) {
  const scaled = (value, decimals) => Math.round(Number(value.toFixed(decimals)) * 10 ** decimals);
  for (let decimals = most; decimals >= Math.max(0, most - 2); decimals -= 1) {
    const total = parts.reduce((all, part) => all + scaled(part, decimals), 0);
    if (total === scaled(sum, decimals)) return decimals;
  }
  return most;
}

const pad = (n) => String(n).padStart(2, '0');

/// h:mm:ss, or m:ss below an hour.
export function clockTime(seconds) {
  const total = Math.round(Math.abs(seconds));
  const sign = seconds < -0.5 ? kMinus : '';
  const hours = Math.floor(total / 3600);
  const minutes = Math.floor((total % 3600) / 60);
  return hours > 0 ? `${sign}${hours}:${pad(minutes)}:${pad(total % 60)}` : `${sign}${minutes}:${pad(total % 60)}`;
}

/// The unit in which a time axis of this length reads well.
export function timeUnit(span_s) {
  if (span_s > 4 * 3600) return { symbol: 'h', seconds: 3600 };
  return span_s > 400 ? { symbol: 'min', seconds: 60 } : { symbol: 's', seconds: 1 };
}

/// "drum torque" of "drum_torque".
export const plain = (key) => String(key).replaceAll('_', ' ');
