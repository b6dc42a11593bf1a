// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { read_coloured_ply } from '../src/coloured_ply.mjs';
import { repack_png } from '../src/png.mjs';
import { region_geometry } from '../src/region_surface.mjs';

const program = fileURLToPath(new URL('../pictures.mjs', import.meta.url));

const header = (vertices, faces) => `ply
format ascii 1.0
element vertex ${vertices}
property double x
property double y
property double z
property uchar red
property uchar green
property uchar blue
property int region
element face ${faces}
property list uchar int vertex_indices
end_header
`;

// A tetrahedron: two corners red, one green, one blue.
const tetrahedron = `${header(4, 4)}0 0 0 255 0 0 7
2 0 0 255 0 0 7
0 2 0 0 255 0 8
0 0 4 0 0 255 9
3 0 2 1
3 0 1 3
3 0 3 2
3 1 2 3
`;

function folder_with(t, files) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'pictures-'));
  t.after(() => fs.rmSync(folder, { recursive: true }));
  for (const [name, text] of Object.entries(files)) fs.writeFileSync(path.join(folder, name), text);
  return folder;
}

const run = (...words) => spawnSync(process.execPath, [program, ...words], { encoding: 'utf8' });

function png_size(file) {
  const bytes = fs.readFileSync(file);
  assert.equal(bytes.toString('latin1', 1, 4), 'PNG');
  return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
}

test('a coloured mesh is read into the unit ball, with linear colours and its regions', (t) => {
  const file = path.join(folder_with(t, { 'a.ply': tetrahedron }), 'a.ply');
  const { positions, colours, regions, faces } = read_coloured_ply(file);
  const radius = Math.sqrt(6);
  assert.deepEqual(positions, Float32Array.from([-1, -1, -2, 1, -1, -2, -1, 1, -2, -1, -1, 2], (x) => x / radius));
  assert.deepEqual([...colours], [1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  assert.deepEqual([...regions], [7, 7, 8, 9]);
  assert.deepEqual([...faces.slice(0, 3)], [0, 2, 1]);
  const lying = read_coloured_ply(file, 'y').positions;
  assert.deepEqual([...lying.slice(9, 12)], [-1, -2, -1].map((x) => Math.fround(x / radius)));
});

test('corners of one region share their weight, and every corner knows the colours of all three', (t) => {
  const mesh = read_coloured_ply(path.join(folder_with(t, { 'a.ply': tetrahedron }), 'a.ply'));
  const { weight, colour_0, colour_1, colour_2 } = region_geometry(mesh).attributes;
  // The first face has corners red, green, red; the second red, red, blue; the fourth one of each.
  assert.deepEqual([...weight.array.slice(0, 9)], [1, 0, 0, 0, 1, 0, 1, 0, 0]);
  assert.deepEqual([...weight.array.slice(9, 18)], [1, 0, 0, 1, 0, 0, 0, 0, 1]);
  assert.deepEqual([...weight.array.slice(27, 36)], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
  for (const corner of [9, 10, 11]) {
    const colours = [colour_0, colour_1, colour_2].map(({ array }) => [...array.slice(3 * corner, 3 * corner + 3)]);
    assert.deepEqual(colours, [[1, 0, 0], [0, 1, 0], [0, 0, 1]]);
  }
});

test('normals of a fine mesh are those of its surface', () => {
  // A saddle of 100 x 100 squares, whose vertices are nearer to each other than a hundredth.
  const n = 100;
  const place = (i) => [(i % (n + 1)) / n - 0.5, Math.floor(i / (n + 1)) / n - 0.5];
  const vertices = Array.from({ length: (n + 1) ** 2 }, (_, i) => place(i));
  const corners = vertices.flatMap(([x, y], i) => (x < 0.5 && y < 0.5 ? [i, i + 1, i + n + 2, i, i + n + 2, i + n + 1] : []));
  const mesh = {
    positions: Float32Array.from(vertices.flatMap(([x, y]) => [0.5 * x, 0.5 * y, x * x - y * y])),
    colours: new Float32Array(3 * vertices.length),
    regions: new Int32Array(vertices.length),
    faces: Uint32Array.from(corners),
  };
  const { normal } = region_geometry(mesh).attributes;
  corners.forEach((vertex, corner) => {
    const [x, y] = vertices[vertex];
    const dot = (normal.getX(corner) * -4 * x + normal.getY(corner) * 4 * y + normal.getZ(corner)) / Math.hypot(4 * x, 4 * y, 1);
    assert.ok(dot > 0.999, `${x}, ${y}: ${dot}`);
  });
});

test('every mesh becomes a picture and all become a sheet, the same in two runs', (t) => {
  const folder = folder_with(t, { 'a.ply': tetrahedron, 'b.ply': tetrahedron });
  const meshes = ['a.ply', 'b.ply'].map((name) => path.join(folder, name));
  const outs = ['first', 'second'].map((name) => path.join(folder, name));
  for (const out of outs) {
    const result = run(out, ...meshes, '--size', '200', '--sheet', path.join(out, 'sheet.png'), '--columns', '1');
    assert.equal(result.stderr, '');
    assert.equal(result.status, 0);
  }
  assert.deepEqual(fs.readdirSync(outs[0]).sort(), ['a.png', 'b.png', 'sheet.png']);
  assert.deepEqual(png_size(path.join(outs[0], 'a.png')), [200, 160]);
  const [width, height] = png_size(path.join(outs[0], 'sheet.png'));
  assert.ok(height > 640 && width < height);
  const bytes = (out, name) => fs.readFileSync(path.join(out, name));
  for (const name of ['a.png', 'b.png', 'sheet.png']) assert.ok(bytes(outs[0], name).equals(bytes(outs[1], name)));
  assert.ok(bytes(outs[0], 'a.png').equals(bytes(outs[0], 'b.png')));
});

test('a PNG packed again is the same picture, and what leaves the packer is what it would give again', () => {
  // One white pixel, as other programs write it.
  const pixel = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAsTj2FAAAAABJRU5ErkJggg==', 'base64');
  const packed = repack_png(pixel);
  assert.ok(packed.equals(repack_png(packed)));
  assert.deepEqual(packed.subarray(0, 33), pixel.subarray(0, 33));
  assert.deepEqual(packed.subarray(-12), pixel.subarray(-12));
});

test('what is no coloured mesh is named in one line, and nothing is written', (t) => {
  const broken = {
    'text.ply': 'hello',
    'plain.ply': tetrahedron.replace(/property uchar \w+\n/g, '').replace(/ (255|0) (255|0) (255|0) (\d)\n/g, ' $4\n'),
    'index.ply': tetrahedron.replace('3 1 2 3', '3 1 2 4'),
    'short.ply': tetrahedron.slice(0, tetrahedron.indexOf('0 2 0')),
    'points.ply': tetrahedron.replace('face 4', 'face 0').replace(/^3 .*\n/gm, ''),
  };
  const folder = folder_with(t, broken);
  for (const name of [...Object.keys(broken), 'missing.ply']) {
    const result = run(path.join(folder, 'out'), path.join(folder, name));
    assert.equal(result.status, 1, name);
    assert.match(result.stderr, new RegExp(`^error: .*${name}: .*\\n$`));
  }
  assert.ok(!fs.existsSync(path.join(folder, 'out')));
});

test('wrong options are errors of one line', (t) => {
  const file = path.join(folder_with(t, { 'a.ply': tetrahedron }), 'a.ply');
  for (const words of [[], ['out'], ['out', file, '--size', 'big'], ['out', file, '--up', 'x'], ['out', file, '--blue'], ['out', file, file]]) {
    const result = run(...words);
    assert.equal(result.status, 1);
    assert.match(result.stderr, /^error: .*\n$/);
  }
});
