// The one time of the page: slider, charts and animation follow it.

export class Clock {
  constructor(start_s, end_s, now_s) {
    this.start_s = start_s;
    this.end_s = end_s;
    this.now_s = now_s;
    this.listeners = [];
  }

  onChange(listener) {
    this.listeners.push(listener);
    listener(this.now_s);
  }

  set(time_s) {
    const next = Math.min(this.end_s, Math.max(this.start_s, time_s));
    if (next === this.now_s) return;
    this.now_s = next;
    this.listeners.forEach((listener) => listener(next));
  }
}

/// Value of a series {t, y} at a time, on the straight line between its points; null where there is none.
export function valueAt(series, time_s) {
  const { t, y } = series;
  if (t.length === 0) return null;
  let low = 0;
  let high = t.length - 1;
  if (time_s <= t[0]) return y[0];
  if (time_s >= t[high]) return y[high];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= time_s) low = middle;
    else high = middle;
  }
  if (y[low] === null || y[high] === null) return y[low];
  const share = (time_s - t[low]) / (t[high] - t[low] || 1);
  return y[low] + share * (y[high] - y[low]);
}

/// Times of the rows of a recording, from stretches [start_s, step_s, number].
export const rowTimes = (stretches) => stretches.flatMap(([start_s, step_s, count]) => Array.from({ length: count }, (_, i) => start_s + i * step_s));

/// The last row at or before a time, or the first row.
export function rowAt(times_s, time_s) {
  let low = 0;
  let high = times_s.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times_s[middle] <= time_s + 1e-6) low = middle;
    else high = middle;
  }
  return low;
}

/// Value that a row of the recording has in a channel {row, y}; null where it has none.
export function recordedAt({ row, y }, at, times_s) {
  const low = rowAt(row, at);
  if (row[low] === at || low + 1 === row.length || y[low] === null || y[low + 1] === null) return y[low];
  const share = (times_s[at] - times_s[row[low]]) / (times_s[row[low + 1]] - times_s[row[low]]);
  return y[low] + share * (y[low + 1] - y[low]);
}
