// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the page's block of data, in the format of docs/page_format.md, for the viewer.
import { Damaged, decode_labels, decode_particles, decode_positions, decode_topology } from './decode.mjs';

const magic = 'LDSTPAGE';
const version = 1;
const preamble = 16;

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
  for (const object of header.objects ?? []) objects.push(await read_object(object, header.frames, section));
  const page = {
    header,
    objects,
    numbers: await json(header.numbers, (lines) => lines.split('\n').filter(Boolean)),
    stages: await json(header.stages),
    candidates: await json(header.candidates),
    contacts: await json(header.contacts),
  };
  return page;
}

async function read_object(object, frames, section) {
  const { vertices, triangles } = object;
  const partitions = [];
  for (const { frame, regions, labels } of object.partitions ?? [])
    partitions.push({ frame, regions, labels: decode_labels(await section(labels), vertices, regions, labels) });
  return {
    ...object,
    corners: decode_topology(await section(object.topology), triangles, vertices, object.topology),
    frames: decode_positions(await section(object.positions), frames, vertices, object.positions),
    partitions,
    particles: object.particles ? decode_particles(await section(object.particles), frames, vertices, object.particles) : null,
  };
}

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
  if (!Number.isInteger(header?.frames) || typeof header.sections !== 'object') throw new Damaged('header: no frames or no sections');
  return { header, body: bytes.subarray(end) };
}

async function inflate(name, place, body) {
  if (!place) throw new Damaged(`${name}: no such section`);
  if (place.offset + place.bytes > body.length) throw new Damaged(`${name}: ends early`);
  if (typeof DecompressionStream === 'undefined') throw new Damaged('this browser is too old: it lacks DecompressionStream');
  const packed = new Blob([body.subarray(place.offset, place.offset + place.bytes)]);
  const stream = packed.stream().pipeThrough(new DecompressionStream('deflate-raw'));
  const content = await new Response(stream).arrayBuffer().catch(() => {
    throw new Damaged(`${name}: cannot be inflated`);
  });
  if (content.byteLength !== place.raw) throw new Damaged(`${name}: ${content.byteLength} bytes, expected ${place.raw}`);
  return new Uint8Array(content);
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
