// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page. Text is set as text, so that nothing from a file becomes markup.

/** @param {string} id @returns {any} the element of the template with that id */
export const by_id = (id) => document.getElementById(id);

/**
 * @param {string} tag
 * @param {Record<string, any>} [properties]  of the element; names with a dash are attributes
 * @param {...(Node | string)} children
 */
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties))
    if (name.includes('-') || name === 'role' || name === 'for') made.setAttribute(name, value);
    else made[name] = value;
  made.append(...children);
  return made;
}

/** The same for SVG; all properties are attributes. */
export function svg_element(tag, attributes = {}, ...children) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

const icons = {
  play: 'M7 4.5v15l12-7.5z',
  pause: 'M6 5h4.2v14H6zM13.8 5H18v14h-4.2z',
  first: 'M5 5h2.6v14H5zM19 5v14L9 12z',
  last: 'M16.4 5H19v14h-2.6zM5 5v14l10-7z',
  back: 'M15.5 5v14L6 12z',
  forward: 'M8.5 5v14l9.5-7z',
  loop: 'M7 7h9V4l5 4.5-5 4.5v-3H9v3H6V8a1 1 0 0 1 1-1zm10 10H8v3l-5-4.5L8 11v3h7v-3h3v5a1 1 0 0 1-1 1z',
};

/** @param {keyof typeof icons} name */
export function icon(name) {
  const picture = svg_element('svg', { viewBox: '0 0 24 24', 'aria-hidden': 'true' }, svg_element('path', { d: icons[name] }));
  return picture;
}

/** 1234.5 -> "1 235", 12.345 -> "12.3"; small numbers keep three digits, so that 0.00312 does not become 0. */
export function number_text(value) {
  if (!Number.isFinite(value)) return '–';
  if (Number.isInteger(value)) return grouped(String(value));
  const digits = Math.abs(value) >= 100 ? value.toFixed(0) : String(Number(value.toPrecision(3)));
  return grouped(digits);
}

function grouped(text) {
  const [whole, part] = text.split('.');
  const spaced = whole.replace(/\B(?=(\d{3})+$)/g, '\u202f');
  return part === undefined ? spaced : `${spaced}.${part}`;
}
