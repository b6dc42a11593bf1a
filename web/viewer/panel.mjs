// SPDX-License-Identifier: GPL-3.0-or-later
// Switches for layers and objects.
import { by_id, element, number_text } from './dom.mjs';
import { state_colour } from './colours.mjs';
import { layers } from './layers.mjs';

/**
 * @param {import('./container.mjs').Page} page
 * @param {import('./layers.mjs').Shown} shown
 * @param {() => number} frame  of the page, at present
 */
export function make_panel(page, shown, frame) {
  const boxes = shown.available.map((layer) => layer_row(layer, shown));
  const { states } = page.header;
  if (states) boxes.find(({ key }) => key === 'regions')?.row.querySelector('.about').append(...state_legend(states));
  by_id('layers').append(...boxes.map(({ row }) => row));
  const rows = page.objects.map((object, i) => object_row(object, i, shown));
  by_id('objects').append(...rows.map(({ row }) => row));
  shown.on_change(() => {
    boxes.forEach(({ box, key }) => (box.checked = shown.layers[key]));
    rows.forEach(({ visible, translucent }, i) => {
      visible.checked = shown.objects[i].visible;
      translucent.checked = shown.objects[i].translucent;
      translucent.disabled = !visible.checked;
    });
  });
  const facts_of = page.objects.map((object) => object_facts(object, page.header.states));
  return () => rows.forEach(({ facts }, i) => set_text(facts, facts_of[i](frame())));
}

function layer_row({ key, name, about }, shown) {
  const number = layers.findIndex((layer) => layer.key === key) + 1;
  const box = element('input', { type: 'checkbox', id: `layer-${key}` });
  box.addEventListener('change', () => shown.set_layer(key, box.checked));
  const row = element('label', { className: 'switch' }, box, element('span', { className: `sample ${key}`, 'aria-hidden': 'true' }),
    element('span', { className: 'name', textContent: name }), element('span', { className: 'about', textContent: about }),
    element('kbd', { textContent: String(number), title: `Key ${number}` }));
  return { key, box, row };
}

/** The names of states, each in its colour. */
function state_legend(states) {
  return states.map((name, i) => {
    const swatch = element('span', { className: 'swatch', 'aria-hidden': 'true' });
    swatch.style.background = `rgb(${state_colour(i).join(' ')})`;
    return element('span', { className: 'state' }, swatch, name);
  });
}

function object_row({ name }, i, shown) {
  const make_box = (property, word) => {
    const box = element('input', { type: 'checkbox', id: `object-${i}-${property}` });
    box.addEventListener('change', () => shown.set_object(i, property, box.checked));
    const whose = element('span', { className: 'spoken', textContent: ` ${name}` });
    return { box, label: element('label', { className: 'small-switch' }, box, word, whose) };
  };
  const visible = make_box('visible', 'visible');
  const translucent = make_box('translucent', 'translucent');
  const facts = element('div', { className: 'about' });
  const title = element('span', { className: 'name', textContent: name, title: name });
  const head = element('div', { className: 'object-head' }, title, visible.label, translucent.label);
  const row = element('div', { className: 'object' }, head, facts);
  return { row, facts, visible: visible.box, translucent: translucent.box };
}

/** @returns {(frame: number) => string} what is said of an object; counted anew only with a new partition */
function object_facts({ vertices, triangles, partitions, particles }, states) {
  const size = `${number_text(vertices)} vertices, ${number_text(triangles)} triangles`;
  let known, text = size;
  return (frame) => {
    const partition = partitions.findLast((candidate) => candidate.frame <= frame);
    if (!partition) return particles ? `${size}, ${number_text(particles[frame].length)} particles` : size;
    if (partition === known) return text;
    known = partition;
    const parts = states ? share_of_states(partition.labels, states) : [`${number_text(partition.regions)} regions`];
    return (text = [size, ...parts].join(', '));
  };
}

/** @returns {string[]} the share of the vertices that are not in the first state */
function share_of_states(labels, states) {
  const counts = states.map(() => 0);
  labels.forEach((label) => ++counts[label]);
  return states.slice(1).map((state, i) => `${Math.round((1000 * counts[i + 1]) / labels.length) / 10} % ${state}`);
}

/** Unchanged text needs no new layout. */
export function set_text(node, text) {
  if (node.textContent !== text) node.textContent = text;
}
