// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the page's block of data, in the format of docs/page_format.md, for the viewer.
import { Damaged, decode_labels, decode_particles, decode_positions, decode_topology } from './decode.mjs';

const magic = 'LDSTPAGE';
const version = 1;
const preamble = 16;
const most_frames = 1e7;
const most_regions = 2 ** 24;

/** An error of a browser that lacks what the page needs, with a message for its reader. */
export class Too_old extends Error {}

/**
 * @typedef {object} Partition
 * @property {number} frame         of the page, from which it applies
 * @property {number} regions
 * @property {Uint32Array} labels   region of each vertex
 *
 * @typedef {object} Page_object
 * @property {string} name
 * @property {number} vertices
 * @property {number} triangles
 * @property {number[]} box                      least x, y, z, then greatest
 * @property {Uint32Array} corners               three per face
 * @property {Uint16Array[]} frames              per frame, see decode_positions
 * @property {Partition[]} partitions
 * @property {Uint32Array[] | null} particles    per frame their vertices
 *
 * @typedef {object} Stage_record
 * @property {Record<string, number>} microseconds
 * @property {boolean} positive
 * @property {boolean} found
 * @property {boolean | null} [near]  null without a tolerance
 * @property {number} nearest
 *
 * @typedef {object} Page
 * @property {Record<string, any>} header
 * @property {Page_object[]} objects
 * @property {string[] | null} numbers           lines of frames.jsonl
 * @property {Stage_record[] | null} stages
 * @property {number[][][] | null} candidates    per frame
 * @property {number[][][] | null} contacts      per frame
 */

/**
 * @param {string} text  base64
 * @returns {Promise<Page>}
 */
export async function read_page(text) {
  const { header, body } = split_container(from_base64(text));
  const section = (name) => inflate(name, header.sections[name], body);
  const json = async (name, parse = JSON.parse) => {
    if (!name) return null;
    const content = await section(name);
    return of_each_frame(name, parse_or_complain(name, () => parse(new TextDecoder().decode(content))), header.frames);
  };
  const objects = [];
  const listed = header.objects ?? [];
  if (!Array.isArray(listed) || !listed.every(is_object)) throw new Damaged('header: objects are not a list');
  for (const object of listed) objects.push(await read_object(object, header.frames, section));
  return {
    header,
    objects,
    numbers: await json(header.numbers, (lines) => lines.split('\n').filter(Boolean)),
    stages: checked_stages(await json(header.stages), header.stages),
    candidates: checked_rows(await json(header.candidates), header.candidates, (row) => is_candidate(row, objects)),
    contacts: checked_rows(await json(header.contacts), header.contacts, (row) => is_contact(row, objects)),
  };
}

async function read_object(object, frames, section) {
  const { vertices, triangles, box } = object;
  if (!is_index(vertices, Infinity) || !is_index(triangles, Infinity) || box?.length !== 6)
    throw new Damaged(`header: object ${object.name} has no size`);
  const partitions = [];
  const listed = object.partitions ?? [];
  if (!Array.isArray(listed) || !listed.every((partition) => is_object(partition) && is_index(partition.regions, most_regions)))
    throw new Damaged(`header: object ${object.name} has no list of partitions`);
  for (const { frame, regions, labels } of listed)
    partitions.push({ frame, regions, labels: decode_labels(await section(labels), vertices, regions, labels) });
  return {
    ...object,
    corners: decode_topology(await section(object.topology), triangles, vertices, object.topology),
    frames: decode_positions(await section(object.positions), frames, vertices, object.positions),
    partitions,
    particles: object.particles ? decode_particles(await section(object.particles), frames, vertices, object.particles) : null,
  };
}

function checked_stages(stages, name) {
  const bad = stages?.findIndex((stage) => !is_object(stage) || !is_object(stage.microseconds)) ?? -1;
  if (bad >= 0) throw new Damaged(`${name}: frame ${bad} has no times`);
  return stages;
}

/** @param {(row: any) => boolean} is_right  of each row of each frame */
function checked_rows(frames, name, is_right) {
  frames?.forEach((rows, frame) => {
    if (!Array.isArray(rows)) throw new Damaged(`${name}: frame ${frame} is not a list`);
    const bad = rows.findIndex((row) => !Array.isArray(row) || !is_right(row));
    if (bad >= 0) throw new Damaged(`${name}: row ${bad} of frame ${frame} cannot be read`);
  });
  return frames;
}

const is_object = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);
const is_index = (value, count) => Number.isInteger(value) && value >= 0 && value < count;

/** Regions are looked up in the frame, where they may have none. */
const is_candidate = ([a, p, b, q], objects) =>
  is_index(a, objects.length) && is_index(b, objects.length) && is_index(p, Infinity) && is_index(q, Infinity);

/** Two faces; after them the six coordinates of two ends, or nothing; after these 1 if the faces are apart. */
const is_contact = (row, objects) => {
  const [a, face_a, b, face_b, ...rest] = row;
  return is_index(face_a, objects[a]?.triangles) && is_index(face_b, objects[b]?.triangles) && [0, 6, 7].includes(rest.length);
};

function from_base64(text) {
  const trimmed = text.trim();
  if (trimmed === '' || trimmed.startsWith('@')) throw new Damaged('this is the template: no data have been put into it');
  try {
    const binary = atob(trimmed);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
  } catch {
    throw new Damaged('the block of data is not base64');
  }
}

function split_container(bytes) {
  if (new TextDecoder().decode(bytes.subarray(0, 8)) !== magic) throw new Damaged('the block of data is not one of Lodestone');
  if (bytes.length < preamble) throw new Damaged('the block of data ends early');
  const view = new DataView(bytes.buffer);
  const found = view.getUint32(8, true);
  if (found !== version) throw new Damaged(`the data are of version ${found}, and this viewer reads version ${version}`);
  const end = preamble + view.getUint32(12, true);
  if (end > bytes.length) throw new Damaged('the block of data ends early');
  const header = parse_or_complain('header', () => JSON.parse(new TextDecoder().decode(bytes.subarray(preamble, end))));
  if (!is_object(header) || !is_index(header.frames, most_frames) || !is_object(header.sections)) throw new Damaged('header: no frames or no sections');
  return { header, body: bytes.subarray(end) };
}

async function inflate(name, place, body) {
  if (!place) throw new Damaged(`${name}: no such section`);
  if (!is_index(place.offset, Infinity) || !is_index(place.bytes, Infinity)) throw new Damaged(`${name}: no such section`);
  if (place.offset + place.bytes > body.length) throw new Damaged(`${name}: ends early`);
  const packed = new Blob([body.subarray(place.offset, place.offset + place.bytes)]);
  const stream = packed.stream().pipeThrough(raw_inflater());
  const content = await new Response(stream).arrayBuffer().catch(() => {
    throw new Damaged(`${name}: cannot be inflated`);
  });
  if (content.byteLength !== place.raw) throw new Damaged(`${name}: ${content.byteLength} bytes, expected ${place.raw}`);
  return new Uint8Array(content);
}

function raw_inflater() {
  try {
    return new DecompressionStream('deflate-raw');
  } catch {
    throw new Too_old('this browser cannot unpack the data: it is too old');
  }
}

function parse_or_complain(name, parse) {
  try {
    return parse();
  } catch {
    throw new Damaged(`${name}: not JSON`);
  }
}

function of_each_frame(name, list, frames) {
  if (!Array.isArray(list) || list.length !== frames) throw new Damaged(`${name}: not one entry for each of ${frames} frames`);
  return list;
}
