// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a frame's contacts: faces that intersect, and faces that are only nearer than the tolerance.

/** @param {number[]} contact  a row of the page @returns {boolean} whether its faces are apart, but within the tolerance */
export const is_apart = (contact) => contact[10] === 1;

/** @param {number[]} contact  a row of the page @returns {boolean} whether it says where its faces meet, or are nearest */
export const has_ends = (contact) => contact.length >= 10;

/**
 * The faces of each object in the contacts of a frame. A face that intersects one and is near another is in
 * `intersecting` alone.
 * @param {number[][]} contacts
 * @param {number} objects
 * @returns {{intersecting: Set<number>, near: Set<number>}[]}
 */
export function faces_of_objects(contacts, objects) {
  const found = Array.from({ length: objects }, () => ({ intersecting: new Set(), near: new Set() }));
  for (const contact of contacts) {
    const [a, face_a, b, face_b] = contact;
    const kind = is_apart(contact) ? 'near' : 'intersecting';
    found[a][kind].add(face_a);
    found[b][kind].add(face_b);
  }
  for (const { intersecting, near } of found) for (const face of intersecting) near.delete(face);
  return found;
}
