// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the bytes of sections to numbers, as docs/page_format.md describes. Independent of the page.

/** An error in the data of a page, with a message for its reader. */
export class Damaged extends Error {}

/** Reads consecutive varints. */
export class Varint_reader {
  /** @param {Uint8Array} bytes @param {string} name  of the section, for messages */
  constructor(bytes, name) {
    this.bytes = bytes;
    this.name = name;
    this.at = 0;
  }

  /** @returns {number} an integer from 0 to 2^53 - 1 */
  next() {
    const byte = this.bytes[this.at++];
    if (byte < 128) return byte;
    return this.#rest(byte);
  }

  /** @returns {number} an integer of either sign */
  next_signed() {
    const n = this.next();
    if (n < 2147483648) return (n >>> 1) ^ -(n & 1);
    return n % 2 === 0 ? n / 2 : -(n + 1) / 2;
  }

  /** Checks, before room is made for them, that so many integers can follow. */
  expect(count) {
    if (!(count <= this.bytes.length - this.at)) throw new Damaged(`${this.name}: ends early`);
  }

  /** Checks that no bytes are left: otherwise the counts of the header are wrong. */
  finish() {
    if (this.at !== this.bytes.length) throw new Damaged(`${this.name}: ${this.bytes.length - this.at} bytes too many`);
  }

  #rest(first) {
    if (first === undefined) throw new Damaged(`${this.name}: ends early`);
    let value = first & 127;
    // Multiplies instead of shifting, since shifts lose bits beyond the 32nd.
    for (let place = 128; place <= 2 ** 49; place *= 128) {
      const byte = this.bytes[this.at++];
      if (byte === undefined) throw new Damaged(`${this.name}: ends early`);
      value += (byte & 127) * place;
      if (value > Number.MAX_SAFE_INTEGER) break;
      if (byte < 128) return value;
    }
    throw new Damaged(`${this.name}: a number is too large`);
  }
}

/** @returns {Uint32Array} corners, three per face */
export function decode_topology(bytes, triangles, vertices, name) {
  const reader = new Varint_reader(bytes, name);
  reader.expect(3 * triangles);
  const corners = new Uint32Array(3 * triangles);
  let corner = 0;
  for (let i = 0; i < 3 * triangles; ++i) {
    corner += reader.next_signed();
    if (!(corner >= 0 && corner < vertices)) throw new Damaged(`${name}: corner ${corner} of ${vertices} vertices`);
    corners[i] = corner;
  }
  reader.finish();
  return corners;
}

/** @returns {Uint16Array[]} per frame x, y, z of each vertex on the grid of the object's box */
export function decode_positions(bytes, frames, vertices, name) {
  const reader = new Varint_reader(bytes, name);
  reader.expect(3 * vertices * frames);
  const decoded = Array.from({ length: frames }, () => new Uint16Array(3 * vertices));
  const continuations = [
    (q, i) => (i < 3 ? 0 : q[i - 3]),
    (_, i, before) => before[i],
    (_, i, before, earlier) => 2 * before[i] - earlier[i],
  ];
  decoded.forEach((q, frame) => {
    const continuation = continuations[Math.min(frame, 2)];
    const [before, earlier] = [decoded[frame - 1], decoded[frame - 2]];
    for (let i = 0; i < 3 * vertices; ++i) {
      const value = reader.next_signed() + continuation(q, i, before, earlier);
      if (!(value >= 0 && value <= 65535)) throw new Damaged(`${name}: a coordinate of frame ${frame} is off the grid`);
      q[i] = value;
    }
  });
  reader.finish();
  return decoded;
}

/** @returns {Uint32Array} the region of each vertex */
export function decode_labels(bytes, vertices, regions, name) {
  const reader = new Varint_reader(bytes, name);
  reader.expect(vertices);
  const labels = new Uint32Array(vertices);
  for (let i = 0; i < vertices; ++i) {
    labels[i] = reader.next();
    if (labels[i] >= regions) throw new Damaged(`${name}: region ${labels[i]} of ${regions}`);
  }
  reader.finish();
  return labels;
}

/** @returns {Uint32Array[]} per frame the vertices of the particles */
export function decode_particles(bytes, frames, vertices, name) {
  const reader = new Varint_reader(bytes, name);
  const decoded = Array.from({ length: frames }, () => {
    const count = reader.next();
    reader.expect(count);
    return Uint32Array.from({ length: count }, () => {
      const vertex = reader.next();
      if (vertex >= vertices) throw new Damaged(`${name}: vertex ${vertex} of ${vertices}`);
      return vertex;
    });
  });
  reader.finish();
  return decoded;
}
