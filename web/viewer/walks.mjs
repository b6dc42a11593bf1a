// SPDX-License-Identifier: GPL-3.0-or-later
// The path of a particle from frame to frame. The page knows only its vertex per frame, so the path is a shortest one
// along edges.

const most_visited = 4000;  // A particle walks a few edges per frame; longer paths become straight lines.

export class Walks {
  /** @param {import('./container.mjs').Page_object} object */
  constructor(object) {
    this.object = object;
    this.known = new Map();
    this.starts = new Set(object.partitions.map(({ frame }) => frame));
    this.neighbours = undefined;
  }

  /**
   * Vertices that particle i passed between the previous frame and this one, oldest first; none if it did not exist
   * yet.
   * @returns {number[]}
   */
  way(frame, i) {
    const [before, now] = [this.object.particles[frame - 1], this.object.particles[frame]];
    if (!before || before.length !== now.length || this.starts.has(frame)) return [];
    if (before[i] === now[i]) return [now[i]];
    const key = `${before[i]} ${now[i]}`;
    if (!this.known.has(key)) this.known.set(key, this.#shortest(before[i], now[i]));
    return this.known.get(key);
  }

  /** Breadth-first from the end, so that following predecessors gives the path in order. */
  #shortest(from, to) {
    this.neighbours ??= neighbours_of(this.object);
    const { first, list } = this.neighbours;
    const next = new Map([[to, to]]);
    for (const vertex of next.keys()) {
      if (next.has(from) || next.size > most_visited) break;
      for (let i = first[vertex]; i < first[vertex + 1]; ++i) if (!next.has(list[i])) next.set(list[i], vertex);
    }
    if (!next.has(from)) return [from, to];
    const way = [from];
    while (way.at(-1) !== to) way.push(next.get(way.at(-1)));
    return way;
  }
}

/** Neighbours of vertex v are in `list` from first[v] to first[v + 1]; some of them twice. */
function neighbours_of({ corners, vertices }) {
  const first = new Uint32Array(vertices + 1);
  for (const vertex of corners) first[vertex + 1] += 2;
  for (let v = 0; v < vertices; ++v) first[v + 1] += first[v];
  const list = new Uint32Array(2 * corners.length);
  const free = first.slice();
  for (let i = 0; i < corners.length; i += 3)
    for (let j = 0; j < 3; ++j) {
      list[free[corners[i + j]]++] = corners[i + ((j + 1) % 3)];
      list[free[corners[i + j]]++] = corners[i + ((j + 2) % 3)];
    }
  return { first, list };
}
