// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the coloured meshes that `lodestone partition --out` writes.
import { PLYLoader } from 'three/addons/loaders/PLYLoader.js';
import { Bad_input, read_file } from './command.mjs';

/**
 * @typedef {object} Coloured_mesh
 * @property {Float32Array} positions  x, y, z of each vertex, about the middle of the mesh, in units of half its diagonal; z up
 * @property {Float32Array} colours    red, green, blue of each vertex; linear, 0 to 1
 * @property {Int32Array}   regions    of each vertex
 * @property {Uint32Array}  faces      three vertices each
 */

/**
 * @param {string} file
 * @param {'y' | 'z'} up  which axis of the file points up
 * @returns {Coloured_mesh}
 */
export function read_coloured_ply(file, up = 'z') {
  const geometry = parse(read_file(file), file);
  const { position, color, region } = geometry.attributes;
  if (!geometry.index || !position) throw new Bad_input(`${file}: no faces`);
  if (!color) throw new Bad_input(`${file}: its vertices have no colours; write it with lodestone partition --out`);
  const faces = new Uint32Array(geometry.index.array);
  if (faces.some((vertex) => vertex >= position.count)) throw new Bad_input(`${file}: a face refers to a vertex that does not exist`);
  if (!position.array.every(Number.isFinite)) throw new Bad_input(`${file}: a coordinate is not finite, or the file ends early`);
  const scale = color.normalized ? 1 / 255 : 1;
  return {
    positions: in_unit_ball(up === 'y' ? with_z_up(position.array) : position.array),
    colours: Float32Array.from({ length: color.array.length }, (_, i) => color.array[i] * scale),
    regions: region ? new Int32Array(region.array) : regions_by_colour(color.array),
    faces,
  };
}

function parse(content, file) {
  if (content.subarray(0, 3).toString() !== 'ply') throw new Bad_input(`${file}: not a PLY file`);
  const loader = new PLYLoader();
  loader.setCustomPropertyNameMapping({ region: ['region'] });
  try {
    return loader.parse(content.buffer.slice(content.byteOffset, content.byteOffset + content.length));
  } catch (error) {
    throw new Bad_input(`${file}: not a PLY file that can be read: ${error.message}`);
  }
}

/** x, y, z with y up become x, -z, y. */
function with_z_up(positions) {
  return positions.map((x, i) => (i % 3 === 0 ? x : i % 3 === 1 ? -positions[i + 1] : positions[i - 1]));
}

function in_unit_ball(positions) {
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  positions.forEach((x, i) => {
    least[i % 3] = Math.min(least[i % 3], x);
    most[i % 3] = Math.max(most[i % 3], x);
  });
  const radius = Math.hypot(...most.map((x, axis) => x - least[axis])) / 2 || 1;
  return Float32Array.from(positions, (x, i) => (x - (least[i % 3] + most[i % 3]) / 2) / radius);
}

function regions_by_colour(colours) {
  const seen = new Map();
  return Int32Array.from({ length: colours.length / 3 }, (_, vertex) => {
    const colour = colours.slice(3 * vertex, 3 * vertex + 3).join();
    if (!seen.has(colour)) seen.set(colour, seen.size);
    return seen.get(colour);
  });
}
