// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { region_colour } from '../viewer/colours.mjs';
import { read_page } from '../viewer/container.mjs';
import { faces_of_objects } from '../viewer/contacts.mjs';
import { Damaged, decode_labels, decode_particles, decode_positions, decode_topology, Varint_reader } from '../viewer/decode.mjs';
import { fold, sharp, vertex_normals } from '../viewer/normals.mjs';
import { outcome_of, runs } from '../viewer/outcome.mjs';
import { first_along } from '../viewer/pick.mjs';
import { common_ball, Places } from '../viewer/places.mjs';
import { Player } from '../viewer/player.mjs';
import { Sharpness } from '../viewer/sharpness.mjs';
import { Walks } from '../viewer/walks.mjs';
import { make_container } from './make_page.mjs';
import { Container_writer, on_grid, particles_section, positions_section, topology_section, varints, zigzag } from './write_container.mjs';

const bytes = (...values) => Uint8Array.from(values);

test('a varint has seven bits per byte, the low ones first', () => {
  const cases = [
    [[0], 0], [[127], 127], [[128, 1], 128], [[255, 127], 16383], [[128, 128, 1], 16384],
    [[255, 255, 255, 255, 15], 2 ** 32 - 1], [[128, 128, 128, 128, 16], 2 ** 32], [[255, 255, 255, 255, 31], 2 ** 33 - 1],
    [[255, 255, 255, 255, 255, 255, 255, 15], Number.MAX_SAFE_INTEGER],
  ];
  for (const [encoded, value] of cases) {
    const reader = new Varint_reader(bytes(...encoded), 'test');
    assert.equal(reader.next(), value);
    reader.finish();
    assert.deepEqual([...varints([value])], encoded);
  }
});

test('zigzag holds small numbers of either sign, and those beyond 32 bits', () => {
  const values = [0, -1, 1, -2, 2, 65535, -65535, 2 ** 30, -(2 ** 30), 2 ** 31 - 1, -(2 ** 31), 2 ** 32 - 1, -(2 ** 32 - 1)];
  assert.deepEqual([0, -1, 1, -2, 2].map(zigzag), [0, 1, 2, 3, 4]);
  const reader = new Varint_reader(varints(values.map(zigzag)), 'test');
  assert.deepEqual(values.map(() => reader.next_signed()), values);
});

test('a varint that ends early, is too long, or is followed by more is an error', () => {
  assert.throws(() => new Varint_reader(bytes(), 'x').next(), new Damaged('x: ends early'));
  assert.throws(() => new Varint_reader(bytes(128, 255), 'x').next(), new Damaged('x: ends early'));
  assert.throws(() => new Varint_reader(bytes(...new Array(9).fill(255), 1), 'x').next(), new Damaged('x: a number is too large'));
  assert.throws(() => new Varint_reader(bytes(1), 'x').finish(), new Damaged('x: 1 bytes too many'));
});

test('positions come back through extreme differences and continuations that leave the grid', () => {
  // Continued, 0 -> 65535 gives 131070 and 65535 -> 0 gives -65535.
  const [one, two, three] = [[0, 65535, 7, 65535, 0, 7], [65535, 0, 7, 0, 65535, 8], [65535, 0, 0, 65535, 0, 65535]];
  const frames = [one, two, one, three].map((q) => Uint16Array.from(q));
  assert.deepEqual(decode_positions(positions_section(frames), 4, 2, 'x'), frames);
  for (const count of [1, 2, 3]) assert.deepEqual(decode_positions(positions_section(frames.slice(0, count)), count, 2, 'x'), frames.slice(0, count));
});

test('many positions come back as they were', () => {
  let state = 1;
  const random = () => (state = (Math.imul(state, 1103515245) + 12345) >>> 0) / 2 ** 32;
  const frames = Array.from({ length: 7 }, () => Uint16Array.from({ length: 300 }, () => Math.floor(65536 * random() ** 3)));
  assert.deepEqual(decode_positions(positions_section(frames), 7, 100, 'x'), frames);
});

test('a coordinate off the grid, a corner or particle without its vertex, and a label without its region are errors', () => {
  assert.throws(() => decode_positions(varints([0, 0, zigzag(65536)]), 1, 1, 'x'), /off the grid/);
  assert.throws(() => decode_positions(varints([zigzag(-1), 0, 0]), 1, 1, 'x'), /off the grid/);
  assert.throws(() => decode_positions(varints([0, 0]), 1, 1, 'x'), /ends early/);
  assert.throws(() => decode_topology(topology_section([0, 1, 3]), 1, 3, 'x'), /corner 3 of 3/);
  assert.throws(() => decode_topology(varints([zigzag(-1), 0, 0]), 1, 3, 'x'), /corner -1/);
  assert.throws(() => decode_particles(particles_section([[3]]), 1, 3, 'x'), /vertex 3 of 3/);
  assert.throws(() => decode_particles(varints([2 ** 40]), 1, 3, 'x'), /ends early/);
  assert.throws(() => decode_labels(varints([2, 0, 0]), 3, 2, 'x'), /region 2 of 2/);
});

test('corners, labels and particles come back, whatever their number from frame to frame', () => {
  const corners = [0, 4000000, 2, 2, 1, 0];
  assert.deepEqual([...decode_topology(topology_section(corners), 2, 4000001, 'x')], corners);
  assert.deepEqual([...decode_labels(varints([0, 299, 130]), 3, 300, 'x')], [0, 299, 130]);
  assert.deepEqual(decode_particles(particles_section([[1, 2], [], [200, 0, 5]]), 3, 201, 'x').map((list) => [...list]), [[1, 2], [], [200, 0, 5]]);
});

test('a flat object is on the grid too', () => {
  assert.deepEqual(on_grid([[0, 0, 5, 1, 2, 5]]).grid, [Uint16Array.of(0, 0, 0, 65535, 65535, 0)]);
});

test('regions have the colours of the files that hold partitions', () => {
  // Hue 0 in lightness 0.75: one channel full, two at a quarter. Region 3 is as dark, its hue 0.854 of the circle.
  assert.deepEqual(region_colour(0), [191, 48, 48]);
  assert.deepEqual(region_colour(3), [191, 48, 173]);
});

test('a normal survives being folded into two bytes, within a degree', () => {
  const unfold = (packed) => {
    const [u, v] = [packed & 255, packed >> 8].map((x) => x / 127.5 - 1);
    const z = 1 - Math.abs(u) - Math.abs(v);
    const [x, y] = z < 0 ? [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)] : [u, v];
    return [x, y, z].map((c) => c / Math.hypot(x, y, z));
  };
  for (let i = 0; i < 500; ++i) {
    const z = 1 - (2 * (i + 0.5)) / 500;
    const n = [Math.sqrt(1 - z * z) * Math.cos(i * 2.4), Math.sqrt(1 - z * z) * Math.sin(i * 2.4), z];
    const back = unfold(fold(...n));
    assert.ok(n.reduce((sum, x, axis) => sum + x * back[axis], 0) > Math.cos(Math.PI / 180), String(n));
  }
});

test('only vertices at sharp edges have no normal of their own', () => {
  // A roof of two squares, whose edge from 0 to 1 is in the middle: 2 3 on one side, 4 5 on the other.
  const corners = Uint32Array.of(1, 0, 2, 1, 2, 3, 0, 1, 4, 4, 1, 5);
  const roof = (slope) => vertex_normals({ corners, vertices: 6 }, [1, 1, 1])(Uint16Array.from([
    [0, 100, 1000], [100, 100, 1000], [0, 0, 1000 - slope], [100, 0, 1000 - slope], [0, 200, 1000 - slope], [100, 200, 1000 - slope],
  ].flat()));
  const sharp_ones = (normals) => [...normals.keys()].filter((v) => normals[v] === sharp);
  assert.deepEqual(sharp_ones(roof(0)), []);
  assert.deepEqual(sharp_ones(roof(50)), []);  // Faces are inclined to the normal of the edge by 27 degrees.
  assert.deepEqual(sharp_ones(roof(200)), [0, 1]);  // By 63.
  assert.equal(roof(0)[0], fold(0, 0, 1));
  for (const lowest of [fold(0, 0, -1), fold(-0, -0, -1), fold(1e-9, 1e-9, -1)]) assert.notEqual(lowest, sharp);
});

test('a frame is confirmed, missed, only near, or without collision, and neighbours form runs', () => {
  const outcomes = [[true, true, true], [true, false, true], [false, false, true], [false, false, false], [false, false, null]]
    .map(([positive, found, near]) => outcome_of({ positive, found, near }));
  assert.deepEqual(outcomes, ['confirmed', 'missed', 'near', 'none', 'none']);
  assert.deepEqual(runs(6, (f) => [0, 1, 4].includes(f)), [[0, 2], [4, 1]]);
});

test('a face that intersects one face and is near another is drawn as intersecting', () => {
  const ends = [0, 0, 0, 1, 0, 0];
  const contacts = [[0, 5, 1, 7, ...ends, 1], [0, 5, 1, 8, ...ends], [0, 6, 1, 8, ...ends, 1], [1, 9, 2, 5], [2, 3, 2, 4, ...ends, 1]];
  const faces = faces_of_objects(contacts, 3);
  assert.deepEqual(faces.map(({ intersecting }) => [...intersecting]), [[5], [8, 9], [5]]);
  assert.deepEqual(faces.map(({ near }) => [...near]), [[6], [7], [3, 4]]);
});

test('a particle walked along edges, and a repartition ends its way', () => {
  // A strip of squares: 0 1 2 3 below, 4 5 6 7 above.
  const corners = Uint32Array.from([0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6]);
  const particles = [[0], [3], [3], [4]].map((list) => Uint32Array.from(list));
  const object = { corners, vertices: 8, partitions: [{ frame: 0 }, { frame: 3 }], particles };
  const walks = new Walks(object);
  assert.deepEqual(walks.way(1, 0), [0, 1, 2, 3]);
  assert.deepEqual(walks.way(2, 0), [3]);
  assert.deepEqual(walks.way(3, 0), []);
  assert.deepEqual(walks.way(0, 0), []);
});

test('objects without vertices, which have been removed, do not count for what is seen', () => {
  const removed = { vertices: 0, box: [0, 0, 0, 0, 0, 0], frames: [new Uint16Array()] };
  const shown = { vertices: 1, box: [8, 8, 8, 10, 8, 8], frames: [Uint16Array.of(65535, 0, 0)] };
  const ball = common_ball([removed, shown]);
  assert.deepEqual(ball, { centre: [9, 8, 8], radius: 1 });
  assert.deepEqual(new Places(removed, ball).samples(9), []);
  assert.deepEqual(new Places(shown, ball).samples(1), [[1, 0, 0]]);
  assert.deepEqual(common_ball([removed]), { centre: [0, 0, 0], radius: 1 });
});

test('a thin part that samples miss is among the vertices that stick out', () => {
  const count = 5000;
  const q = new Uint16Array(3 * count).fill(30000);
  const tips = [[1234, [50000, 50000, 50000]], [77, [0, 30000, 30000]], [901, [65535, 30000, 30000]], [902, [30000, 65535, 30000]], [903, [30000, 30000, 65535]]];
  for (const [vertex, place] of tips) q.set(place, 3 * vertex);
  const object = { vertices: count, box: [-1, -1, -1, 1, 1, 1], frames: [new Uint16Array(3 * count).fill(30000), q] };
  const places = new Places(object, common_ball([object]));
  const holds = (list, vertex) => list.some((place) => String(place) === String(places.of_vertex(1, vertex)));
  for (const vertex of [1234, 77]) {
    assert.ok(!holds(places.samples(400), vertex), 'a part that samples find would test nothing');
    assert.ok(holds(places.extremes(), vertex));
  }
  assert.deepEqual(new Places({ vertices: 0, box: object.box, frames: [new Uint16Array()] }, common_ball([object])).extremes(), []);
});

test('the first face along a ray is found, from either side, and none beside it or behind', () => {
  // Two squares across the z-axis, at z = 0 and 1, of two triangles each.
  const corners = Uint32Array.of(0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7);
  const square = (z) => [[0, 0, z], [65535, 0, z], [65535, 65535, z], [0, 65535, z]].flat();
  const object = { vertices: 8, corners, box: [-1, -1, 0, 1, 1, 1], frames: [Uint16Array.from([...square(0), ...square(65535)])] };
  const places = new Places(object, { centre: [0, 0, 0], radius: 1 });
  const look = (from, along) => first_along(places, 0, ...[from, along].map(([x, y, z]) => ({ x, y, z })));
  for (const [x, y] of [[0.5, -0.5], [-0.5, 0.5], [0.9, 0.9]]) {
    assert.ok(Math.abs(look([x, y, 3], [0, 0, -1]) - 2) < 1e-6);
    assert.ok(Math.abs(look([x, y, -3], [0, 0, 2]) - 1.5) < 1e-6);
    assert.ok(Math.abs(look([x, y, 0.5], [0, 0, -1]) - 0.5) < 1e-6);
  }
  assert.equal(look([0, 0, 3], [0, 0, 1]), Infinity);
  assert.equal(look([1.1, 0, 3], [0, 0, -1]), Infinity);
  assert.equal(look([0, 0, 3], [1, 0, 0]), Infinity);
});

/** Calls what waits for the next picture, after some milliseconds. */
async function in_fake_time(act) {
  const saved = { requestAnimationFrame: globalThis.requestAnimationFrame, now: performance.now };
  let now = 0;
  const waiting = [];
  globalThis.requestAnimationFrame = (call) => waiting.push(call);
  performance.now = () => now;
  try {
    await act((milliseconds) => {
      now += milliseconds;
      waiting.splice(0).forEach((call) => call(now));
    }, () => now);
  } finally {
    globalThis.requestAnimationFrame = saved.requestAnimationFrame;
    performance.now = saved.now;
  }
}

test('a machine is slow if pictures take long, not if they are seldom', async () => {
  await in_fake_time((pass, now) => {
    const draw = (sharpness, takes, waits) => {
      for (let i = 0; i < 12; ++i) {
        sharpness.next_draw(now());
        pass(takes);
        pass(waits);
      }
      clearTimeout(sharpness.timer);
      return sharpness.ratio(100, 100);
    };
    const made = () => new Sharpness(() => true, () => {});
    assert.equal(draw(made(), 16, 1000), 2);
    assert.equal(draw(made(), 80, 0), 1);
    const resting = new Sharpness(() => false, () => {});
    assert.equal(draw(resting, 80, 0), 2);
  });
});

test('a player that pauses and plays within one picture is as fast as before', () => {
  const waiting = new Map();
  let last = 0;
  const { requestAnimationFrame, cancelAnimationFrame } = globalThis;
  globalThis.requestAnimationFrame = (tick) => (waiting.set(++last, tick), last);
  globalThis.cancelAnimationFrame = (id) => waiting.delete(id);
  try {
    const player = new Player({ frames: 1000, frames_per_second: 10 });
    player.play();
    for (let i = 0; i < 5; ++i) player.toggle(), player.toggle();
    assert.equal(waiting.size, 1);
    const begin = performance.now();
    for (let picture = 1; picture <= 20; ++picture) {
      const ticks = [...waiting.values()];
      waiting.clear();
      ticks.forEach((tick) => tick(begin + 100 * picture));
    }
    assert.ok(Math.abs(player.frame - 20) <= 1, `frame ${player.frame}`);
    player.pause();
    assert.equal(waiting.size, 0);
  } finally {
    Object.assign(globalThis, { requestAnimationFrame, cancelAnimationFrame });
  }
});

/** A page of one triangle that moves through two frames, with changes. */
function small_page({ header = {}, object = {}, sections = {} }) {
  const writer = new Container_writer();
  const add = (name, content) => writer.add(name, sections[name] ?? content);
  const one = {
    name: 'one', vertices: 3, triangles: 1, box: [0, 0, 0, 1, 1, 1], topology: add('topology 0', topology_section([0, 1, 2])),
    positions: add('positions 0', positions_section([new Uint16Array(9), new Uint16Array(9)])), particles: null,
    partitions: [{ frame: 0, regions: 1, labels: add('labels 0.0', varints([0, 0, 0])) }], ...object,
  };
  const stage = { microseconds: { refit: 1 }, positive: false, found: false, nearest: 1 };
  const whole = {
    frames: 2, objects: [one, { ...one, name: 'two' }], numbers: null, stages: add('stages', [stage, stage]),
    candidates: add('candidates', [[], [[0, 0, 1, 0, 0.5]]]), contacts: add('contacts', [[[0, 0, 1, 0]], [[0, 0, 1, 0, 0, 0, 0, 1, 1, 1, 1]]]), ...header,
  };
  if (header.sections === null) writer.sections = null;
  return read_page(writer.finish(whole).toString('base64'));
}

test('whatever a damaged page holds, its reader is told what is wrong', async () => {
  assert.equal((await small_page({})).contacts[1][0].length, 11);
  const cases = [
    [{ header: { frames: -1 } }, /^header: no frames/],
    [{ header: { frames: 1e12 } }, /^header: no frames/],
    [{ header: { sections: null } }, /^header: no frames or no sections$/],
    [{ header: { frames: 1e6 } }, /^positions 0: ends early$/],
    [{ object: { vertices: 1e9 } }, /^labels 0.0: ends early$/],
    [{ object: { triangles: 1e9 } }, /^topology 0: ends early$/],
    [{ object: { vertices: null } }, /^header: object one has no size$/],
    [{ header: { objects: {} } }, /^header: objects are not a list$/],
    [{ header: { objects: [null] } }, /^header: objects are not a list$/],
    [{ object: { partitions: 3 } }, /^header: object one has no list of partitions$/],
    [{ object: { partitions: [null] } }, /^header: object one has no list of partitions$/],
    [{ object: { partitions: [{ frame: 0, regions: 1e9, labels: 'labels 0.0' }] } }, /^header: object one has no list of partitions$/],
    [{ object: { box: [0, 0, 0] } }, /^header: object one has no size$/],
    [{ object: { partitions: [{ frame: 0, regions: 1, labels: 'none' }] } }, /^none: no such section$/],
    [{ sections: { stages: [{}, {}] } }, /^stages: frame 0 has no times$/],
    [{ sections: { stages: [null, null] } }, /^stages: frame 0 has no times$/],
    [{ sections: { stages: [] } }, /^stages: not one entry/],
    [{ sections: { candidates: [[], 7] } }, /^candidates: frame 1 is not a list$/],
    [{ sections: { candidates: [[], [[0, 0, 2, 0, 1]]] } }, /^candidates: row 0 of frame 1 cannot be read$/],
    [{ sections: { candidates: [[[0, -1, 1, 0, 1]], []] } }, /^candidates: row 0 of frame 0 cannot be read$/],
    [{ sections: { contacts: [[], [[0, 0, 1, 0], [0, 0, 1, 1]]] } }, /^contacts: row 1 of frame 1 cannot be read$/],
    [{ sections: { contacts: [[[0, 0, 5, 0]], []] } }, /^contacts: row 0 of frame 0 cannot be read$/],
    [{ sections: { contacts: [[[0, 0, 1, 0, 1, 2]], []] } }, /^contacts: row 0 of frame 0 cannot be read$/],
    [{ sections: { contacts: [[null], []] } }, /^contacts: row 0 of frame 0 cannot be read$/],
  ];
  for (const [change, message] of cases)
    await assert.rejects(small_page(change), (error) => error instanceof Damaged && message.test(error.message) || assert.fail(`${JSON.stringify(change)}: ${error.message}`));
});

test('every kind of page is read', async () => {
  for (const kind of ['partition', 'experiment', 'exact', 'near', 'sampled']) {
    const { bytes, log } = make_container(kind);
    const page = await read_page(bytes.toString('base64'));
    if (kind === 'near') assert.deepEqual(page.contacts, log.map(({ contacts }) => contacts));
  }
});
