// SPDX-License-Identifier: GPL-3.0-or-later
// Adds to a synthetic run what a tolerance finds: faces that are near but apart.

const place_of = ({ frames }, f, vertex) => frames[f].slice(3 * vertex, 3 * vertex + 3);

/** For each vertex one of its faces. */
function faces_at({ corners }) {
  const faces = new Map();
  corners.forEach((vertex, i) => faces.set(vertex, Math.floor(i / 3)));
  return faces;
}

/** Vertices stand for faces: those of the two objects that are nearer to each other than the tolerance. */
function near_rows([first, second], f, tolerance) {
  const rows = [];
  const others = [...faces_at(second)].map(([vertex, face]) => [face, place_of(second, f, vertex)]);
  for (const [vertex, face] of faces_at(first)) {
    const p = place_of(first, f, vertex);
    for (const [other, q] of others)
      if (Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) < tolerance) rows.push([0, face, 1, other, ...p, ...q, 1]);
  }
  return rows;
}

/** @returns {object[]} the log of the run, with near contacts behind those that intersect */
export function with_near_contacts({ objects, log }, tolerance) {
  return log.map((entry, f) => {
    const crossing = new Set(entry.contacts.map(([, face_a, , face_b]) => `${face_a} ${face_b}`));
    const near = near_rows(objects, f, tolerance).filter(([, face_a, , face_b]) => !crossing.has(`${face_a} ${face_b}`));
    const contacts = [...entry.contacts, ...near];
    return { ...entry, contacts, near: contacts.length > 0 };
  });
}
