// Pictures of what is no chart: a table as it is laid out, and a drawing in SVG with the styles that it is shown with.
import { svg } from './dom.js';
import { color } from './theme.js';

const kMargin_px = 8;
const kShown = ['fill', 'fill-opacity', 'stroke', 'stroke-width', 'stroke-dasharray', 'stroke-linejoin', 'stroke-linecap', 'opacity', 'paint-order', 'display', 'font-family', 'font-size', 'font-weight', 'text-anchor'];

/// Lines of a text in the window: [{text, box}].
function linesOf(node) {
  const range = document.createRange();
  const lines = [];
  for (const word of node.data.matchAll(/\S+/g)) {
    range.setStart(node, word.index);
    range.setEnd(node, word.index + word[0].length);
    const box = range.getBoundingClientRect();
    if (box.width === 0) continue;
    const last = lines.at(-1);
    if (last && Math.abs(last.box.top - box.top) < 2) last.text += ` ${word[0]}`;
    else lines.push({ text: word[0], box });
  }
  return lines;
}

/// Background and frame of an element.
function frameOf(element, style, place) {
  const box = place(element.getBoundingClientRect());
  const isFilled = !/^(transparent|rgba\(.*, 0\))$/.test(style.backgroundColor);
  const isMarked = style.boxShadow.includes('inset');
  if ((!isFilled && !isMarked) || box.width === 0) return null;
  return svg('rect', { ...box, fill: isFilled ? style.backgroundColor : 'none', stroke: isMarked ? color('ink') : undefined, 'stroke-width': isMarked ? 2 : undefined });
}

/// A table with its texts, shades and frames: {svg, width, height}.
export function drawTable(table) {
  const frame = table.getBoundingClientRect();
  const place = ({ left, top, width, height }) => ({ x: (left - frame.left + kMargin_px).toFixed(1), y: (top - frame.top + kMargin_px).toFixed(1), width: width.toFixed(1), height: height.toFixed(1) });
  const frames = [];
  const texts = [];
  for (const element of [table, ...table.querySelectorAll('*')]) {
    const style = getComputedStyle(element);
    frames.push(frameOf(element, style, place));
    for (const node of element.childNodes) {
      if (node.nodeType !== Node.TEXT_NODE) continue;
      for (const { text, box } of linesOf(node)) {
        const { x, y, height } = place(box);
        texts.push(svg('text', { x, y: (Number(y) + 0.78 * Number(height)).toFixed(1), fill: style.color, 'font-family': style.fontFamily, 'font-size': style.fontSize, 'font-weight': style.fontWeight }, text));
      }
    }
  }
  const [width, height] = [frame.width + 2 * kMargin_px, frame.height + 2 * kMargin_px].map(Math.ceil);
  return { svg: svg('svg', { width, height, viewBox: `0 0 ${width} ${height}` }, frames, texts), width, height };
}

/// A drawing as it is now: {svg, width, height}.
export function drawSvg(drawing) {
  const { width, height } = drawing.getBoundingClientRect();
  const copy = drawing.cloneNode(true);
  const parts = [...drawing.querySelectorAll('*')];
  [...copy.querySelectorAll('*')].forEach((part, i) => {
    const style = getComputedStyle(parts[i]);
    for (const name of kShown) part.style.setProperty(name, style.getPropertyValue(name));
    part.removeAttribute('class');
  });
  copy.setAttribute('width', Math.ceil(width));
  copy.setAttribute('height', Math.ceil(height));
  return { svg: copy, width: Math.ceil(width), height: Math.ceil(height) };
}
