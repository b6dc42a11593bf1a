// SPDX-License-Identifier: GPL-3.0-or-later
// The bar of all frames and, below it, the selected window, with a lane for each kind of mark.
import { element, svg_element } from './dom.mjs';
import { frame_kinds, outcome_of, outcome_words, runs } from './outcome.mjs';

const least_frames = 12;  // in the window
const lane_height = 10;
const tick_steps = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];

export class Timeline {
  /**
   * @param {HTMLElement} root
   * @param {import('./container.mjs').Page} page
   * @param {import('./player.mjs').Player} player
   */
  constructor(root, page, player) {
    this.page = page;
    this.player = player;
    this.window = [0, player.frames];
    this.pointers = new Map();
    const nothing = { kind: 'lane', name: 'frames', is: () => false };  // The page has no results.
    const kinds = frame_kinds(page);
    const lanes = (kinds.length > 0 ? kinds : [nothing]).map((lane) => ({ ...lane, runs: runs(player.frames, lane.is) }));
    this.heads = [0, 1].map(() => element('div', { className: 'head' }));
    this.bracket = element('div', { className: 'bracket' });
    this.ticks = element('div', { className: 'ticks' });
    const outcomes = lanes.filter(({ kind }) => ['confirmed', 'missed', 'near', 'lane'].includes(kind));
    const overview = bars(player.frames, outcomes.map((lane) => ({ ...lane, top: 0 })), lane_height);
    const distance = lane_height + 2;
    this.detail = bars(player.frames, lanes.map((lane, i) => ({ ...lane, top: 2 + i * distance })), 2 + lanes.length * distance);
    this.tracks = [
      element('div', { className: 'overview' }, overview, this.bracket, this.heads[0]),
      element('div', { className: 'detail' }, this.detail, this.ticks, this.heads[1]),
    ];
    const all = { name: 'all frames', about: kinds.length > 0 ? 'something was found or missed' : undefined };
    root.append(lane_names([all], 'overview'), this.tracks[0], lane_names(lanes, 'detail'), this.tracks[1]);
    this.root = root;
    this.#listen();
    new ResizeObserver(() => this.#show_window()).observe(root);
    player.on_change(() => this.#follow());
  }

  /** @param {number} factor  above 1: fewer frames, larger @param {number} [around]  frame that keeps its position */
  zoom(factor, around = this.player.frame + 0.5) {
    const [start, length] = this.window;
    const wanted = Math.min(this.player.frames, Math.max(Math.min(least_frames, this.player.frames), length / factor));
    this.#set_window(around - ((around - start) * wanted) / length, wanted);
  }

  show_all() {
    this.#set_window(0, this.player.frames);
  }

  #set_window(start, length) {
    this.window = [Math.min(Math.max(0, start), this.player.frames - length), length];
    this.#show_window();
  }

  #show_window() {
    const [start, length] = this.window;
    const { frames } = this.player;
    this.detail.setAttribute('viewBox', `${start} 0 ${length} ${this.detail.dataset.height}`);
    Object.assign(this.bracket.style, { left: percent(start / frames), width: percent(length / frames) });
    this.bracket.hidden = length >= frames;
    this.#show_ticks();
    this.#show_heads();
  }

  #show_ticks() {
    const [start, length] = this.window;
    const most = Math.max(2, this.tracks[1].clientWidth / 56);
    const step = tick_steps.find((candidate) => (length * this.player.frame_step) / candidate <= most) ?? 50000;
    const marks = [];
    const last = this.player.scene_frame(Math.ceil(start + length) - 1);
    for (let number = Math.ceil(this.player.scene_frame(Math.floor(start)) / step) * step; number <= last; number += step) {
      const at = ((number - this.player.first_frame) / this.player.frame_step + 0.5 - start) / length;
      if (at >= 0 && at <= 1) marks.push(element('span', { textContent: String(number), style: `left: clamp(1.2em, ${percent(at)}, 100% - 1.2em)` }));
    }
    this.ticks.replaceChildren(...marks);
  }

  #show_heads() {
    const { frame, frames } = this.player;
    const [start, length] = this.window;
    this.heads[0].style.left = percent((frame + 0.5) / frames);
    this.heads[1].style.left = percent((frame + 0.5 - start) / length);
    // A frame has the width of its mark, once that is visible.
    this.heads[1].style.width = `max(3px, ${percent(1 / length)})`;
  }

  /** The window follows a frame that leaves it. */
  #follow() {
    const { frame, playing, scene_frame } = this.player;
    const [start, length] = this.window;
    const stage = this.page.stages?.[frame];
    this.root.setAttribute('aria-valuenow', String(scene_frame.call(this.player)));
    this.root.setAttribute('aria-valuemin', String(this.player.scene_frame(0)));
    this.root.setAttribute('aria-valuemax', String(this.player.scene_frame(this.player.frames - 1)));
    const outcome = stage ? `, ${outcome_words[outcome_of(stage)].toLowerCase()}` : '';
    this.root.setAttribute('aria-valuetext', `frame ${this.player.scene_frame()}${outcome}`);
    if (frame < start || frame + 1 > start + length) this.#set_window(playing ? frame - 0.1 * length : frame + 0.5 - length / 2, length);
    else this.#show_heads();
  }

  #listen() {
    // What a slider must know beside the keys of the page.
    const steps = { ArrowUp: 1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
    this.root.addEventListener('keydown', (event) => {
      if (!(event.key in steps) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      this.player.pause();
      this.player.goto(Math.min(this.player.frames - 1, Math.max(0, this.player.frame + steps[event.key])));
    });
    this.tracks.forEach((track, i) => {
      track.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        track.setPointerCapture(event.pointerId);
        this.pointers.set(event.pointerId, event.clientX);
        if (this.pointers.size === 1) this.#scrub(track, i, event.clientX);
      });
      track.addEventListener('pointermove', (event) => {
        if (!this.pointers.has(event.pointerId)) return;
        if (this.pointers.size === 2) this.#pinch(track, event);
        this.pointers.set(event.pointerId, event.clientX);
        if (this.pointers.size === 1) this.#scrub(track, i, event.clientX);
      });
      for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'])
        track.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
      track.addEventListener('wheel', (event) => {
        event.preventDefault();
        this.zoom(2 ** (-event.deltaY / 300), this.#frame_at(track, i, event.clientX));
      }, { passive: false });
    });
  }

  #frame_at(track, i, x) {
    const { left, width } = track.getBoundingClientRect();
    const [start, length] = i === 0 ? [0, this.player.frames] : this.window;
    return start + ((x - left) / width) * length;
  }

  #scrub(track, i, x) {
    this.player.pause();
    const [start, length] = i === 0 ? [0, this.player.frames] : this.window;
    // Frames that are whole in the window: another would move the window under the pointer, again and again.
    const [first, last] = [Math.ceil(start - 1e-6), Math.floor(start + length + 1e-6) - 1];
    this.player.goto(Math.min(last, Math.max(first, Math.floor(this.#frame_at(track, i, x)))));
  }

  #pinch(track, event) {
    const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
    const before = Math.abs(this.pointers.get(event.pointerId) - other);
    const now = Math.abs(event.clientX - other);
    if (before > 8 && now > 8) this.zoom(now / before, this.#frame_at(track, 1, (event.clientX + other) / 2));
  }
}

const percent = (part) => `${100 * part}%`;

/** The names of lanes, beside them. */
function lane_names(lanes, track) {
  const names = lanes.map(({ name, about }) => element('span', { textContent: name, title: about ? `Frames in which ${about}` : '' }));
  return element('div', { className: `lane-names of-${track}` }, ...names);
}

/** A picture as wide as the number of frames, stretched to its container. */
function bars(frames, lanes, height) {
  const viewBox = `0 0 ${frames} ${height}`;
  const picture = svg_element('svg', { viewBox, preserveAspectRatio: 'none', 'data-height': height, 'aria-hidden': 'true' });
  const bar = (kind, top, first, count) => picture.append(svg_element('rect', { class: kind, x: first, y: top, width: count, height: lane_height }));
  for (const { top } of lanes) bar('lane', top, 0, frames);
  for (const { kind, top, runs: parts } of lanes) for (const [first, count] of parts) bar(kind, top, first, count);
  picture.style.height = `${height}px`;
  return picture;
}
