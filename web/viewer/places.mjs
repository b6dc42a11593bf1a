// SPDX-License-Identifier: GPL-3.0-or-later
// Positions. The scene is moved and scaled into the unit ball, since 32-bit floats are too coarse far from zero.

/** @param {import('./container.mjs').Page_object[]} objects @returns {{centre: number[], radius: number}} of all boxes */
export function common_ball(objects) {
  const shown = objects.filter(({ vertices }) => vertices > 0);  // removed ones have none
  if (shown.length === 0) return { centre: [0, 0, 0], radius: 1 };
  const least = [0, 1, 2].map((axis) => shown.reduce((x, { box }) => Math.min(x, box[axis]), Infinity));
  const most = [3, 4, 5].map((axis) => shown.reduce((x, { box }) => Math.max(x, box[axis]), -Infinity));
  // Halves, since sums and differences of coordinates can overflow.
  const half = most.map((x, axis) => x / 2 - least[axis] / 2);
  const radius = Math.min(4 * Math.hypot(...half.map((x) => x / 4)), Number.MAX_VALUE);
  return { centre: least.map((x, axis) => x / 2 + most[axis] / 2), radius: radius || 1 };
}

/** The axes and the diagonals of a cube. */
const directions = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [1, 1, -1], [1, -1, 1], [-1, 1, 1]];

/** Positions on one object. */
export class Places {
  /** @param {import('./container.mjs').Page_object} object @param {{centre: number[], radius: number}} ball */
  constructor(object, ball) {
    const { centre, radius } = ball;
    this.object = object;
    this.ball = ball;
    this.origin = [0, 1, 2].map((axis) => ((object.box[axis] / 2 - centre[axis] / 2) / radius) * 2);
    this.cell = [0, 1, 2].map((axis) => (((object.box[axis + 3] / 2 - object.box[axis] / 2) / radius) * 2) / 65535);
  }

  /** @returns {[number, number, number]} of a vertex in a frame of the page */
  of_vertex(frame, vertex) {
    const q = this.object.frames[frame];
    const [x, y, z] = this.origin;
    const [sx, sy, sz] = this.cell;
    return [x + sx * q[3 * vertex], y + sy * q[3 * vertex + 1], z + sz * q[3 * vertex + 2]];
  }

  /** Positions of about `count` vertices, from all frames. */
  samples(count) {
    const { frames, vertices } = this.object;
    if (vertices === 0) return [];
    // Steps of the golden section sample every frame and every part of the mesh.
    return Array.from({ length: count }, (_, i) =>
      this.of_vertex(Math.floor((i / count) * frames.length), Math.floor(((i * 0.6180339887498949) % 1) * vertices)));
  }

  /** Positions of the vertices that stick out farthest, in some frames, lest samples miss a thin part. */
  extremes(most_frames = 8) {
    const { frames, vertices } = this.object;
    if (vertices === 0) return [];
    const count = Math.min(most_frames, frames.length);
    const chosen = Array.from({ length: count }, (_, i) => Math.round((i * (frames.length - 1)) / Math.max(1, count - 1)));
    return chosen.flatMap((frame) => directions.flatMap((d) => this.#ends_along(d, frames[frame]).map((v) => this.of_vertex(frame, v))));
  }

  /** The least and the greatest vertex along a direction. */
  #ends_along(direction, q) {
    const [x, y, z] = direction.map((d, axis) => d * this.cell[axis]);
    let [least, most, first, last] = [Infinity, -Infinity, 0, 0];
    for (let v = 0, i = 0; i < q.length; ++v, i += 3) {
      const along = x * q[i] + y * q[i + 1] + z * q[i + 2];
      if (along < least) [least, first] = [along, v];
      if (along > most) [most, last] = [along, v];
    }
    return [first, last];
  }

  /** The partition that applies to a frame. */
  partition(frame) {
    return this.object.partitions.findLast((partition) => partition.frame <= frame);
  }

  /** @returns {[number, number, number] | undefined} of the particle of a region */
  of_particle(frame, region) {
    const vertex = this.object.particles?.[frame][region];
    return vertex === undefined ? undefined : this.of_vertex(frame, vertex);
  }
}
