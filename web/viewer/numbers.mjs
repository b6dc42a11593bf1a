// SPDX-License-Identifier: GPL-3.0-or-later
// The figures of the frame: its line of frames.jsonl, and the time of each stage.
import { by_id, element, number_text } from './dom.mjs';
import { misses_nothing } from './outcome.mjs';
import { set_text } from './panel.mjs';

const names = {
  iterations: 'Iterations', moves: 'Moves', relaxed: 'Relaxed', candidates: 'Candidates', exact_tests: 'Exact tests', contacts: 'Contacts',
  builds: 'Builds', repartitions: 'Repartitions', leaf_tests: 'Leaf tests', rebuilds: 'Rebuilds',
};

export const stage_names = {
  build: 'Build', repartition: 'Repartition', refit: 'Refit', broad_phase: 'Broad phase', relaxation: 'Relaxation', candidates: 'Candidates',
  confirmation: 'Confirmation',
};

const words_of = (key) => key.replaceAll('_', ' ').replace(/^./, (c) => c.toUpperCase());

/** @param {import('./container.mjs').Page} page @param {number} frame @returns {any} the frame's line, parsed */
export function line_of(page, frame) {
  const text = page.numbers?.[frame];
  if (text === undefined) return null;
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

/** Rows are reused, so that playing changes only text. */
class Rows {
  constructor(root, make) {
    this.root = root;
    this.make = make;
    this.rows = new Map();
  }

  show(values) {
    const keys = Object.keys(values);
    if (keys.join('\n') !== [...this.rows.keys()].join('\n')) {
      this.rows = new Map(keys.map((key) => [key, this.make(key)]));
      this.root.replaceChildren(...[...this.rows.values()].flatMap(({ nodes }) => nodes));
    }
    keys.forEach((key) => this.rows.get(key).set(values[key]));
  }
}

/** @param {import('./container.mjs').Page} page @returns {(frame: number) => void} shows those of a frame */
export function make_numbers(page) {
  const statistics = new Rows(by_id('statistics'), figure_row);
  const pairs = new Rows(by_id('pairs'), () => pair_row(misses_nothing(page) ? 'apart' : 'apart or not found', !page.header.first_contacts));
  // Building, which few frames do, would make all other bars short.
  const every_frame = ({ microseconds: { build, ...others } }) => Object.values(others);
  const most = (page.stages ?? []).flatMap(every_frame).reduce((a, b) => Math.max(a, b), 1e-9);
  const used = Object.keys(stage_names).filter((key) => page.stages?.some(({ microseconds }) => microseconds[key] > 0));
  const stages = new Rows(by_id('stage-times'), (key) => stage_row(key, most));
  const show_count = make_pair_list();
  const has_distances = page.stages?.some(({ nearest }) => nearest !== null && nearest !== undefined);
  return (frame) => {
    const line = line_of(page, frame);
    const stage = page.stages?.[frame];
    by_id('statistics').classList.toggle('long', Boolean(line && !line.pairs));
    if (line && !line.pairs) statistics.show(scalars_of(line));
    if (line?.pairs) {
      const colliding = line.pairs.filter(({ collides }) => collides).length;
      statistics.show({ ...line.statistics, 'colliding pairs': colliding, ...(stage && has_distances ? { 'nearest distance': stage.nearest } : {}) });
      pairs.show({ ...found_first(line.pairs) });  // By their places, since objects can have the same name.
      show_count(line.pairs.length);
    }
    if (stage) {
      const sum = Object.values(stage.microseconds).reduce((a, b) => a + b, 0);
      stages.show({ ...Object.fromEntries(used.map((key) => [key, stage.microseconds[key] ?? 0])), sum });
    }
  };
}

const in_view = 6;  // pairs that the list shows at once

/** Says how many pairs there are where the list scrolls, and fades its last rows while there are more below. */
function make_pair_list() {
  const [list, text] = [by_id('pairs'), by_id('pair-count')];
  const fade = () => list.classList.toggle('more', list.scrollHeight - list.scrollTop - list.clientHeight > 2);
  list.addEventListener('scroll', fade);
  return (count) => {
    const scrolls = count > in_view;
    text.hidden = !scrolls;
    set_text(text, scrolls ? `${number_text(count)} pairs of objects; scroll for more` : '');
    list.tabIndex = scrolls ? 0 : -1;
    fade();
  };
}

/** Pairs of which something was found, or missed, before all others, where the list does not show all at once. */
function found_first(pairs) {
  if (pairs.length <= in_view) return pairs;
  const is_found = (pair) => Boolean(pair.collides || pair.truth || pair.near || pair.inside);
  return [...pairs.filter(is_found), ...pairs.filter((pair) => !is_found(pair))];
}

/** The numbers of a line that has no pairs, that of a partition, its measures among them. */
function scalars_of(line) {
  return Object.fromEntries(Object.entries({ ...line, ...line.measures }).filter(([, value]) => typeof value === 'number'));
}

function figure_row(key) {
  const value = element('dd', { id: `number-${key.replaceAll(' ', '_')}` });
  const set = (figure) => set_text(value, typeof figure === 'boolean' ? (figure ? 'yes' : 'no') : number_text(figure));
  return { nodes: [element('div', {}, element('dt', { textContent: names[key] ?? words_of(key) }), value)], set };
}

/** How many pairs of faces are contacts: those that intersect, and apart from them those that are only near. */
function faces_text({ faces, intersects, collides, capped }) {
  if (!faces) return '';
  const or_more = capped ? ' or more' : '';
  const pairs_of = (count) => `, ${count}${or_more} face ${count === 1 ? 'pair' : 'pairs'}`;
  if (!collides || !intersects) return pairs_of(faces.length);
  const crossing = intersects.filter(Boolean).length;
  const apart = faces.length - crossing;
  return `${pairs_of(crossing)}${apart > 0 ? `, ${apart}${or_more} near` : ''}`;
}

/**
 * @param {string} otherwise  what to say of a pair of which the frame found nothing
 * @param {boolean} lists_all  whether all contacts were asked for, so that their number says something
 */
function pair_row(otherwise, lists_all) {
  const [a, b] = [element('bdi'), element('bdi')];  // Names may be in scripts of either direction.
  const name = element('span', { className: 'name' }, a, ' – ', b);
  const state = element('span', { className: 'state' });
  const set = (pair) => {
    set_text(a, pair.a);
    set_text(b, pair.b);
    const missed = pair.truth && !pair.collides;
    const faces = lists_all ? faces_text(pair) : '';
    const inside = pair.inside ? `, ${pair.inside} inside` : '';
    set_text(state, pair.collides ? `collide${faces}` : missed ? 'collide, not found' : pair.near ? `near${faces}${inside}` : pair.inside ? `${pair.inside} inside` : otherwise);
    state.className = `state ${pair.collides ? 'confirmed' : missed ? 'missed' : pair.near ? 'near' : ''}`;
  };
  return { nodes: [element('li', {}, name, state)], set };
}

/** A bar with a square-root scale, since stages differ by a factor of a thousand. */
function stage_row(key, most) {
  const value = element('dd', { id: `stage-${key}` });
  const bar = element('i', { className: `bar ${key}` });
  const set = (microseconds) => {
    set_text(value, `${number_text(microseconds)} µs`);
    bar.classList.toggle('cut', microseconds > most);
    bar.style.width = `${100 * Math.min(1, Math.sqrt(microseconds / most))}%`;
  };
  const name = key === 'sum' ? 'All stages' : stage_names[key] ?? words_of(key);
  const track = element('span', { className: 'track' }, ...(key === 'sum' ? [] : [bar]));
  return { nodes: [element('div', { className: key }, element('dt', { textContent: name }), track, value)], set };
}
