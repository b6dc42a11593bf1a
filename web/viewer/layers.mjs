// SPDX-License-Identifier: GPL-3.0-or-later
// The layers that can be shown and hidden, and which of them a page has.
import { has_ends, is_apart } from './contacts.mjs';

/**
 * @typedef {object} Layer
 * @property {string} key
 * @property {string} name
 * @property {string} about  in a word or two
 * @property {boolean} on    at first
 * @property {(page: import('./container.mjs').Page) => boolean} exists
 */

/** @type {Layer[]} in the order of their number keys */
export const layers = [
  { key: 'surfaces', name: 'Surfaces', about: 'the meshes', on: true, exists: () => true },
  { key: 'regions', name: 'Region colours', about: 'one each', on: true, exists: has_regions },
  { key: 'wireframe', name: 'Wireframe', about: 'edges of triangles', on: false, exists: () => true },
  { key: 'particles', name: 'Particles', about: 'one per region', on: true, exists: has_particles },
  { key: 'trails', name: 'Trails', about: 'where they walked', on: true, exists: (page) => has_particles(page) && page.header.frames > 1 },
  { key: 'candidates', name: 'Candidate pairs', about: 'regions to check', on: true, exists: (page) => has_any(page.candidates) },
  { key: 'segments', name: 'Contact segments', about: 'where they cross', on: true, exists: (page) => has_any(page.contacts, (c) => has_ends(c) && !is_apart(c)) },
  { key: 'faces', name: 'Intersecting faces', about: 'found exactly', on: true, exists: (page) => has_any(page.contacts, (c) => !is_apart(c)) },
  { key: 'near', name: 'Near faces', about: 'within the tolerance', on: true, exists: (page) => has_any(page.contacts, is_apart) },
];

function has_regions(page) {
  return page.objects.some((object) => object.partitions.length > 0);
}

function has_particles(page) {
  return page.objects.some((object) => object.particles?.some((list) => list.length > 0));
}

function has_any(lists, fits = () => true) {
  return Boolean(lists?.some((list) => list.some(fits)));
}

/** Whether the lines of a frame's candidate pairs would cover the surfaces. */
function has_many_candidates(page) {
  const most_shown = 60;
  return Boolean(page.candidates?.some((list) => list.length > most_shown));
}

/** The layer of regions shows states where the page has some. */
function as_states(layer, states) {
  return states && layer.key === 'regions' ? { ...layer, name: 'What was read', about: '' } : layer;
}

/** The current visibility: layers, and per object whether it is visible and whether it is translucent. */
export class Shown {
  /** @param {import('./container.mjs').Page} page */
  constructor(page) {
    this.available = layers.filter((layer) => layer.exists(page)).map((layer) => as_states(layer, page.header.states));
    this.layers = Object.fromEntries(layers.map(({ key, on }) => [key, on && !(key === 'candidates' && has_many_candidates(page))]));
    this.objects = page.objects.map(() => ({ visible: true, translucent: false }));
    this.listeners = [];
  }

  on_change(listener) {
    this.listeners.push(listener);
    listener();
  }

  set_layer(key, on) {
    this.layers[key] = on;
    this.#changed();
  }

  /** @param {number} object @param {'visible' | 'translucent'} property */
  set_object(object, property, on) {
    this.objects[object][property] = on;
    this.#changed();
  }

  #changed() {
    this.listeners.forEach((listener) => listener());
  }
}
