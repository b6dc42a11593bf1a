// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the format of docs/page_format.md, implemented from that text alone.
import { deflateRawSync } from 'node:zlib';

/** @param {Iterable<number>} values  integers >= 0 */
export function varints(values) {
  const bytes = [];
  for (let value of values) {
    for (; value >= 128; value = Math.floor(value / 128)) bytes.push((value % 128) + 128);
    bytes.push(value);
  }
  return Buffer.from(bytes);
}

/** @param {number} n */
export const zigzag = (n) => (n >= 0 ? 2 * n : -2 * n - 1);

/** @param {number[]} corners */
export function topology_section(corners) {
  return varints(corners.map((corner, i) => zigzag(corner - (i > 0 ? corners[i - 1] : 0))));
}

/** @param {Uint16Array[]} frames  x, y, z of each vertex on the grid */
export function positions_section(frames) {
  const parts = frames.map((q, f) =>
    varints(Array.from(q, (value, i) => {
      if (f === 0) return zigzag(value - (i >= 3 ? q[i - 3] : 0));
      if (f === 1) return zigzag(value - frames[0][i]);
      return zigzag(value - (2 * frames[f - 1][i] - frames[f - 2][i]));
    })));
  return Buffer.concat(parts);
}

/** @param {number[][]} particles  per frame */
export const particles_section = (particles) => varints(particles.flatMap((list) => [list.length, ...list]));

/** @param {number[][]} frames  coordinates @returns {{box: number[], grid: Uint16Array[]}} */
export function on_grid(frames) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (const frame of frames)
    frame.forEach((x, i) => {
      box[i % 3] = Math.min(box[i % 3], x);
      box[3 + (i % 3)] = Math.max(box[3 + (i % 3)], x);
    });
  const extent = (axis) => box[axis + 3] - box[axis] || 1;
  return { box, grid: frames.map((frame) => Uint16Array.from(frame, (x, i) => Math.round((65535 * (x - box[i % 3])) / extent(i % 3)))) };
}

/** Collects sections, and concatenates them. */
export class Container_writer {
  sections = {};
  packed = [];

  /** @param {string} name @param {Buffer | string | object} content  bytes, text, or an object to store as JSON @returns {string} the name */
  add(name, content) {
    const raw = Buffer.isBuffer(content) ? content : Buffer.from(typeof content === 'string' ? content : JSON.stringify(content));
    const stored = deflateRawSync(raw);
    this.sections[name] = { offset: this.packed.reduce((sum, { length }) => sum + length, 0), bytes: stored.length, raw: raw.length };
    this.packed.push(stored);
    return name;
  }

  /** @param {object} header  without `sections` */
  finish(header) {
    const text = Buffer.from(JSON.stringify({ ...header, sections: this.sections }));
    const numbers = Buffer.alloc(8);
    numbers.writeUInt32LE(1, 0);
    numbers.writeUInt32LE(text.length, 4);
    return Buffer.concat([Buffer.from('LDSTPAGE'), numbers, text, ...this.packed]);
  }
}

/** @param {string} template @param {string} title @param {Buffer | string} data  bytes, or text to insert unchanged */
export function fill(template, title, data) {
  const escaped = title.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
  const text = Buffer.isBuffer(data) ? data.toString('base64') : data;
  return template.replace('@LODESTONE_TITLE@', () => escaped).replace('@LODESTONE_DATA@', () => text);
}
