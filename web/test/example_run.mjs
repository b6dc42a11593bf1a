// SPDX-License-Identifier: GPL-3.0-or-later
// A synthetic run: a wobbling torus knot, and a sphere that passes through it. The results only resemble those of the
// method.

const length = ([x, y, z]) => Math.hypot(x, y, z);
const less = (a, b) => a.map((x, i) => x - b[i]);
const mixed = (a, b, t) => a.map((x, i) => x + t * (b[i] - x));

/** A closed grid of rows x columns, both of which wrap, as a torus. */
function torus_faces(rows, columns) {
  const at = (i, j) => (i % rows) * columns + (j % columns);
  return square_faces(rows, columns, at);
}

/** Rows from pole to pole. The poles are rows of coinciding vertices. */
function sphere_faces(rows, columns) {
  return square_faces(rows - 1, columns, (i, j) => i * columns + (j % columns));
}

function square_faces(rows, columns, at) {
  const corners = [];
  for (let i = 0; i < rows; ++i)
    for (let j = 0; j < columns; ++j) corners.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
  return corners;
}

function knot_positions(rows, columns, t) {
  const place = (s) => {
    const angle = 2 * Math.PI * s;
    const ring = 1 + 0.4 * Math.cos(3 * angle);
    return [ring * Math.cos(2 * angle), ring * Math.sin(2 * angle), 0.4 * Math.sin(3 * angle) + 0.08 * Math.sin(2 * angle + 9 * t)];
  };
  const positions = [];
  for (let i = 0; i < rows; ++i) {
    const [p, ahead] = [place(i / rows), place(i / rows + 1e-4)];
    const along = less(ahead, p).map((x) => x / length(less(ahead, p)));
    const side = [-along[1], along[0], 0].map((x) => x / Math.hypot(along[0], along[1]));
    const up = [along[1] * side[2] - along[2] * side[1], along[2] * side[0] - along[0] * side[2], along[0] * side[1] - along[1] * side[0]];
    for (let j = 0; j < columns; ++j) {
      const around = (-2 * Math.PI * j) / columns;
      const radius = 0.2 * (1 + 0.12 * Math.sin((12 * Math.PI * i) / rows + 20 * t));
      positions.push(...p.map((x, axis) => x + radius * (Math.cos(around) * side[axis] + Math.sin(around) * up[axis])));
    }
  }
  return positions;
}

const sphere_middle = (t) => [2.3 - 3.6 * t, 0.5 * Math.sin(5 * t), 0.25 * Math.cos(7 * t)];
const sphere_radius = ([x, y, z], t) => 0.34 * (1 + 0.07 * Math.sin(4 * x + 14 * t) * Math.cos(3 * y - 2 * z));

function sphere_positions(rows, columns, t) {
  const middle = sphere_middle(t);
  const positions = [];
  for (let i = 0; i < rows; ++i)
    for (let j = 0; j < columns; ++j) {
      const [down, around] = [(Math.PI * i) / (rows - 1), (2 * Math.PI * j) / columns];
      const direction = [Math.sin(down) * Math.cos(around), Math.sin(down) * Math.sin(around), Math.cos(down)];
      positions.push(...direction.map((x, axis) => middle[axis] + x * sphere_radius(direction, t)));
    }
  return positions;
}

/** Farthest-point sampling of seed vertices; each vertex belongs to the nearest seed. */
function nearest_seed_labels(positions, regions) {
  const vertices = positions.length / 3;
  const place = (v) => positions.slice(3 * v, 3 * v + 3);
  const labels = new Array(vertices).fill(0);
  const nearest = new Array(vertices).fill(Infinity);
  let seed = 0;
  for (let region = 0; region < regions; ++region) {
    let farthest = 0;
    for (let v = 0; v < vertices; ++v) {
      const distance = length(less(place(v), place(seed)));
      if (distance < nearest[v]) [nearest[v], labels[v]] = [distance, region];
      if (nearest[v] > nearest[farthest]) farthest = v;
    }
    seed = farthest;
  }
  return labels;
}

function neighbours_of(corners, vertices) {
  const lists = Array.from({ length: vertices }, () => new Set());
  corners.forEach((corner, i) => lists[corner].add(corners[i - (i % 3) + ((i + 1) % 3)]).add(corners[i - (i % 3) + ((i + 2) % 3)]));
  return lists.map((set) => [...set]);
}

/** @param {{rows: number, columns: number, regions: number}[]} shapes  of knot and sphere @param {number} frames */
export function example_run([knot, sphere], frames) {
  const time = (f) => f / Math.max(1, frames - 1);
  const objects = [
    { name: 'knot', shape: knot, faces_of: torus_faces, positions_of: knot_positions },
    { name: 'sphere', shape: sphere, faces_of: sphere_faces, positions_of: sphere_positions },
  ].map(({ name, shape: { rows, columns, regions }, faces_of, positions_of }) => ({
    name,
    regions,
    corners: faces_of(rows, columns),
    frames: Array.from({ length: frames }, (_, f) => positions_of(rows, columns, time(f))),
  }));
  for (const object of objects) {
    const vertices = object.frames[0].length / 3;
    const starts = frames > 1 ? [0, Math.floor(frames / 2)] : [0];
    object.partitions = starts.map((frame) => ({ frame, labels: nearest_seed_labels(object.frames[frame], object.regions) }));
    object.neighbours = neighbours_of(object.corners, vertices);
    object.particles = [];
  }
  const log = Array.from({ length: frames }, (_, f) => play_frame(objects, sphere, f, time(f)));
  return { objects, log };
}

function play_frame(objects, sphere, f, t) {
  const place = (i, vertex) => objects[i].frames[f].slice(3 * vertex, 3 * vertex + 3);
  const { moves, iterations } = walk(objects, f, place);
  const [first, second] = objects.map(({ particles }) => particles[f]);
  const links = first.flatMap((p, a) => second.map((q, b) => [0, a, 1, b, length(less(place(0, p), place(1, q)))]));
  const mu = length(less(place(0, 0), place(0, 1)));
  const contacts = crossings(objects, sphere, t, place);
  // Synthetic misses: at times no pair of particles is near.
  const candidates = f % 29 < 4 ? [] : links.filter((link) => link[4] < 2.5 * mu).sort((a, b) => a[4] - b[4]);
  const positive = contacts.length > 0;
  const found = positive && candidates.length > 0;
  const nearest = positive ? 0 : Math.min(...links.map((link) => link[4]));
  return { moves, iterations, candidates, contacts: found ? contacts : [], positive, found, nearest };
}

/** Particles walk within their regions towards the nearest particle of the other object. */
function walk(objects, f, place) {
  const starts = objects.map((object) => {
    const partition = object.partitions.findLast(({ frame }) => frame <= f);
    object.labels = partition.labels;
    return partition.frame === f ? Array.from({ length: object.regions }, (_, region) => partition.labels.indexOf(region)) : object.particles[f - 1];
  });
  let now = starts, moves = 0, iterations = 0;
  for (; iterations < 3; ++iterations) {
    const next = objects.map((object, i) => now[i].map((vertex) => {
      const others = now[1 - i].map((other) => place(1 - i, other));
      const distance = (v) => Math.min(...others.map((other) => length(less(place(i, v), other))));
      const options = [vertex, ...object.neighbours[vertex].filter((v) => object.labels[v] === object.labels[vertex])];
      return options.reduce((best, v) => (distance(v) < distance(best) ? v : best));
    }));
    const moved = next.flat().filter((vertex, i) => vertex !== now.flat()[i]).length;
    now = next;
    moves += moved;
    if (moved === 0) break;
  }
  objects.forEach((object, i) => (object.particles[f] = now[i]));
  return { moves, iterations };
}

/** Faces of the knot with corners inside and outside the sphere, each with the sphere's face nearest in direction. */
function crossings(objects, { rows, columns }, t, place) {
  const middle = sphere_middle(t);
  const depth = (p) => {
    const away = less(p, middle);
    return length(away) - sphere_radius(away.map((x) => x / length(away)), t);
  };
  const vertices = objects[0].neighbours.length;
  const depths = Array.from({ length: vertices }, (_, v) => depth(place(0, v)));
  const found = [];
  const { corners } = objects[0];
  for (let face = 0; face < corners.length / 3; ++face) {
    const [a, b, c] = corners.slice(3 * face, 3 * face + 3);
    const cut = [[a, b], [b, c], [c, a]].filter(([u, v]) => depths[u] < 0 !== depths[v] < 0);
    if (cut.length !== 2) continue;
    const [from, to] = cut.map(([u, v]) => mixed(place(0, u), place(0, v), depths[u] / (depths[u] - depths[v])));
    const away = less(mixed(from, to, 0.5), middle);
    const i = Math.min(rows - 2, Math.floor(((rows - 1) * Math.acos(away[2] / length(away))) / Math.PI));
    const j = Math.floor((columns * (Math.atan2(away[1], away[0]) / (2 * Math.PI) + 1)) % columns);
    found.push([0, face, 1, 2 * (i * columns + j), ...from, ...to]);
  }
  return found;
}
