// Elements, made in one expression.

function make(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : value);
  }
  for (const child of children.flat(Infinity)) {
    if (child !== undefined && child !== null && child !== false) element.append(child);
  }
  return element;
}

/// h('p', {class: 'note'}, 'text', child, [more])
export const h = (tag, attributes, ...children) => make(document.createElement(tag), attributes, children);

/// The same in SVG.
export const svg = (tag, attributes, ...children) =>
  make(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);

export const set = (element, attributes) => make(element, attributes, []);
