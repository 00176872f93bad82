// Compares the boxes of a page as it is laid out.

/// What is wrong with the boxes of the page as it is laid out now, as sentences. Runs in the page.
export const kFindProblems = `(() => {
  const problems = new Set();
  const short = (text) => text.trim().replace(/\\s+/g, ' ').slice(0, 40);
  const meet = (a, b, by) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > by && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > by;
  // Numbers of an axis, side by side or one above the other.
  const isNumber = (text) => /^[-\\u2212+\\d.,e]+$/.test(text.trim());
  const touch = (a, b) => meet(a, b, 1) && Math.abs(a.right - b.right) < 2 || Math.abs(a.top - b.top) < 2 && Math.max(a.left, b.left) - Math.min(a.right, b.right) < 6;
  const wide = document.documentElement.classList.contains('paper') ? document.querySelector('#page').getBoundingClientRect().right + 1 : innerWidth;

  // Texts of charts: those of axes, titles and legends stay apart, and inside of their chart.
  for (const chart of document.querySelectorAll('.chart')) {
    if (chart.offsetParent === null) continue; // of a part that is not shown
    const frame = chart.getBoundingClientRect();
    if (frame.height < 80) problems.add('a chart of ' + Math.round(frame.height) + ' px height');
    const texts = [...chart.querySelectorAll('svg text')].map((text) => ({ text: text.textContent, box: text.getBoundingClientRect() })).filter(({ text, box }) => text.trim() && box.width > 0);
    for (const { text, box } of texts) {
      if (box.left < frame.left - 1.5 || box.right > frame.right + 1.5 || box.top < frame.top - 1.5 || box.bottom > frame.bottom + 1.5) problems.add('cut at the edge of its chart: ' + short(text));
    }
    texts.sort((a, b) => a.box.top - b.box.top);
    for (let i = 0; i < texts.length; ++i) {
      for (let k = i + 1; k < texts.length && texts[k].box.top < texts[i].box.bottom; ++k) {
        if (meet(texts[i].box, texts[k].box, 2.5)) problems.add('one over the other: ' + short(texts[i].text) + ' | ' + short(texts[k].text));
        else if (isNumber(texts[i].text) && isNumber(texts[k].text) && touch(texts[i].box, texts[k].box)) problems.add('read as one number: ' + short(texts[i].text) + ' | ' + short(texts[k].text));
      }
    }
    // No legend lies over a plot.
    const instance = rollrig.chartAt(chart);
    for (const { name, legend, plot } of instance ? rollrig.legendsAndPlots(instance) : []) {
      if (meet(legend, plot, 1)) problems.add('a legend over a plot: ' + name);
    }
  }
  // Texts of the page: each inside of the window, not cut by its own box, and none over another.
  const leaves = [...document.querySelectorAll('main h2, main h3, main p, main li, main th, main td, main dt, main dd, main caption, main figcaption, main summary, header h1, header p, nav a, .now, .zoom')]
    .filter((one) => one.offsetParent !== null && one.textContent.trim() && !one.closest('.chart'));
  const boxes = leaves.map((one) => ({ one, box: one.getBoundingClientRect() })).filter(({ box }) => box.width > 0 && box.height > 0);
  for (const { one, box } of boxes) {
    if (one.closest('.scroll')) continue; // it goes on when it is moved
    if (box.right > wide + 1 || box.left < -1) problems.add('beyond the edge of the page: ' + short(one.textContent));
    const style = getComputedStyle(one);
    if (one.scrollWidth > one.clientWidth + 1 && style.display !== 'inline' && style.overflowX !== 'visible') problems.add('cut: ' + short(one.textContent));
  }
  for (const box of document.querySelectorAll('.tile')) {
    if (box.scrollWidth > box.clientWidth + 1 || box.scrollHeight > box.clientHeight + 1) problems.add('beyond its tile: ' + short(box.textContent));
  }
  const inOrder = boxes.filter(({ one }) => !one.querySelector('p, li, td, th, dd, dt')).sort((a, b) => a.box.top - b.box.top);
  for (let i = 0; i < inOrder.length; ++i) {
    for (let k = i + 1; k < inOrder.length && inOrder[k].box.top < inOrder[i].box.bottom; ++k) {
      const [a, b] = [inOrder[i], inOrder[k]];
      if (a.one.contains(b.one) || b.one.contains(a.one) || a.one.closest('.scroll') !== b.one.closest('.scroll')) continue;
      if (meet(a.box, b.box, 2.5)) problems.add('one over the other: ' + short(a.one.textContent) + ' | ' + short(b.one.textContent));
    }
  }
  if (document.documentElement.scrollWidth > innerWidth + 1) problems.add('the page is wider than its window');
  return [...problems];
})()`;
