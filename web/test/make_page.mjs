// SPDX-License-Identifier: GPL-3.0-or-later
// Writes pages for inspection and tests: make_page TEMPLATE OUT_FILE [KIND]
import fs from 'node:fs';
import { fileURLToPath } from 'node:url';
import { example_run } from './example_run.mjs';
import { with_near_contacts } from './near_contacts.mjs';
import { Container_writer, fill, on_grid, particles_section, positions_section, topology_section, varints } from './write_container.mjs';

const sizes = {
  run: { shapes: [{ rows: 175, columns: 20, regions: 48 }, { rows: 25, columns: 28, regions: 12 }], frames: 300 },  // 3500 and 700 vertices
  large: { shapes: [{ rows: 500, columns: 50, regions: 64 }, { rows: 159, columns: 158, regions: 32 }], frames: 60 },  // about 50 000 triangles each
  small: { shapes: [{ rows: 60, columns: 10, regions: 16 }, { rows: 13, columns: 14, regions: 8 }], frames: 40 },
  partition: { shapes: [{ rows: 175, columns: 20, regions: 32 }, { rows: 3, columns: 3, regions: 1 }], frames: 1 },
};

export const report = `# Does it walk?

Two settings on **one** scene, with \`--truth\`; <script>alert(1)</script> stays text.

| mesh | particles | recall | a \\| b |
| :--- | ---: | ---: | :---: |
| knot | 12 | 0.906 | x |
| sphere | 32 | 0.979 | \`y\` |

## How

- one
- two, which goes on
  in the next line

\`\`\`
lodestone experiment walks | head
\`\`\`
`;

const own_plot = {
  name: 'sweep',
  title: 'Recall by particles',
  description: 'Each point is a run.',
  spec: {
    data: { values: [12, 16, 32, 64].map((n) => ({ n, recall: 1 - 1.2 / n })) },
    mark: 'point',
    encoding: { x: { field: 'n', type: 'quantitative' }, y: { field: 'recall', type: 'quantitative' } },
  },
};

export const particles_note = 'Mode particles may miss collisions: it missed some.';

/** Of the runs of kind `near`. */
export const near_tolerance = 0.12;

/** Of the pairs of a crowd, which all have the same names, every fifth collides where the knot and the sphere do. */
export const crowd_pairs = 45;

/** Of the objects of kind `names`. */
export const long_names = ['a_body_with_a_name_that_has_no_place_to_break_but_goes_on_and_on.off', 'גוף שני'];

/** Of the kinds whose results differ from those of the run. */
const logs = {
  exact: ({ log }) => log.map((entry) => ({ ...entry, found: entry.positive })),
  near: (run) => with_near_contacts(run, near_tolerance),
  crowd: ({ objects, log }) => log.map((entry) => ({ ...entry, candidates: all_region_pairs(objects, entry.nearest) })),
};

const all_region_pairs = ([first, second], distance) =>
  Array.from({ length: first.regions * second.regions }, (_, i) => [0, Math.floor(i / second.regions), 1, i % second.regions, distance]);

/**
 * @param {'run' | 'large' | 'small' | 'partition' | 'experiment' | 'exact' | 'near' | 'crowd' | 'sampled' | 'bare' | 'names'} kind
 * @returns {{bytes: Buffer, lines: string[], log: object[]}} the container, its lines of frames.jsonl, and the
 * synthetic data
 */
export function make_container(kind) {
  const writer = new Container_writer();
  const title = `Example & test: ${kind}`;
  const empty = {
    title, mode: null, strategy: null, frames: 0, first_frame: 0, frame_step: 1, frames_per_second: 30, note: null, objects: [],
    numbers: null, stages: null, candidates: null, contacts: null, plots: [], report: null,
  };
  if (kind === 'experiment') return { bytes: writer.finish({ ...empty, kind, plots: [own_plot], report }), lines: [], log: [] };
  const { shapes, frames } = sizes[kind] ?? sizes.small;
  const run = example_run(shapes, frames);
  const { objects } = run;
  const log = logs[kind]?.(run) ?? run.log;
  const still = kind === 'partition';
  const shown = still ? objects.slice(0, 1) : objects;
  const exact = kind === 'exact' || kind === 'near';
  const header = {
    ...empty,
    kind: still ? 'partition' : 'detect',
    mode: still ? null : exact ? 'exact' : 'particles',
    strategy: exact ? null : 'lbg',
    note: still || exact ? null : particles_note,
    frames,
    ...(kind === 'sampled' ? { frame_step: 10, first_contacts: true } : {}),
    objects: shown.map((object, i) => add_object(writer, object, i, exact || kind === 'bare')),
  };
  const lines = log.map((entry, f) => JSON.stringify((changed_lines[kind] ?? ((line) => line))(line_of(entry, f, exact))));
  if (still) header.numbers = writer.add('numbers', `${JSON.stringify(partition_line(shown[0]))}\n`);
  if (!still && kind !== 'bare') {
    header.numbers = writer.add('numbers', `${lines.join('\n')}\n`);
    header.stages = writer.add('stages', log.map(stage_of));
    if (!exact) header.candidates = writer.add('candidates', log.map(({ candidates }) => candidates));
    header.contacts = writer.add('contacts', log.map(({ contacts }) => contacts.map((contact) => (kind === 'exact' ? contact.slice(0, 4) : contact))));
  }
  return { bytes: writer.finish(header), lines, log };
}

function add_object(writer, object, i, exact) {
  const { box, grid } = on_grid(object.frames);
  const partitions = object.partitions.map(({ frame, labels }, j) =>
    ({ frame, regions: object.regions, labels: writer.add(`labels ${i}.${j}`, varints(labels)) }));
  return {
    name: object.name,
    vertices: object.neighbours.length,
    triangles: object.corners.length / 3,
    box,
    topology: writer.add(`topology ${i}`, topology_section(object.corners)),
    positions: writer.add(`positions ${i}`, positions_section(grid)),
    partitions: exact ? [] : partitions,
    particles: exact ? null : writer.add(`particles ${i}`, particles_section(object.particles)),
  };
}

/** In the format of src/program/frame_log.cpp. */
function line_of({ moves, iterations, candidates, contacts, positive, found, near }, frame, exact) {
  const sorted = [...contacts].sort((p, q) => p[1] - q[1] || p[3] - q[3]);
  const faces = sorted.map(([, face_a, , face_b]) => [face_a, face_b]);
  const counts = { exact_tests: 4 * candidates.length, contacts: contacts.length, builds: frame === 0 ? 2 : 0 };
  const statistics = exact
    ? { leaf_tests: candidates.length, ...counts, rebuilds: 0 }
    : { iterations, moves, relaxed: iterations < 3, candidates: candidates.length, ...counts, repartitions: 0 };
  const within = near === undefined ? {} : { near, intersects: sorted.map(({ length }) => length === 10) };
  return { frame, pairs: [{ a: 'knot', b: 'sphere', collides: found, faces, ...within, truth: positive }], statistics };
}

function in_crowd({ pairs: [pair], ...line }) {
  const apart = { a: 'body', b: 'body', collides: false, faces: [], truth: false };
  return { ...line, pairs: Array.from({ length: crowd_pairs }, (_, i) => (i % 5 === 4 ? { ...pair, a: 'body', b: 'body' } : apart)) };
}

function with_long_names({ pairs: [pair], ...line }) {
  const [a, b] = long_names;
  return { ...line, pairs: [{ ...pair, a, b }] };
}

const changed_lines = { crowd: in_crowd, names: with_long_names };

/** In the format of src/program/partition_command.cpp. */
const partition_line = ({ regions, corners }) => ({ mesh: 'knot.off', strategy: 'lbg', triangles: corners.length / 3, regions, measures: { size_balance: 1.5 } });

/** Times are synthetic, and the same in each run. */
function stage_of({ candidates, iterations, positive, found, near = null, nearest }, frame) {
  const noise = (i) => 0.8 + 0.4 * ((Math.imul(frame * 8 + i + 1, 2654435761) >>> 8) / 2 ** 24);
  const times = {
    build: frame === 0 ? 5000 : 0, repartition: frame % 60 === 30 ? 900 : 1, refit: 0, broad_phase: 0.2, relaxation: 4 + 3 * iterations, candidates: 0.8,
    confirmation: 2.2 * candidates.length,
  };
  const microseconds = Object.fromEntries(Object.entries(times).map(([name, time], i) => [name, Number((time * noise(i)).toFixed(3))]));
  return { microseconds, positive, found, near, nearest };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [template, out, kind = 'run'] = process.argv.slice(2);
  fs.writeFileSync(out, fill(fs.readFileSync(template, 'utf8'), `Example & test: ${kind}`, make_container(kind).bytes));
}
