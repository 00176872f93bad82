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
