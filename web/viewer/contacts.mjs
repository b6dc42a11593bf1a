// SPDX-License-Identifier: GPL-3.0-or-later
// The rows of a frame's contacts: faces that intersect, and faces that are only nearer than the tolerance.

/** @param {number[]} contact  a row of the page @returns {boolean} whether its faces are apart, but within the tolerance */
export const is_apart = (contact) => contact[10] === 1;

/** @param {number[]} contact  a row of the page @returns {boolean} whether it says where its faces meet, or are nearest */
export const has_ends = (contact) => contact.length >= 10;

/**
 * The faces of one object in the contacts of a frame. A face that intersects one and is near another is in
 * `intersecting` alone.
 * @param {number[][]} contacts
 * @param {number} object
 * @returns {{intersecting: Set<number>, near: Set<number>}}
 */
export function faces_in(contacts, object) {
  const [intersecting, near] = [new Set(), new Set()];
  for (const contact of contacts) {
    const [a, face_a, b, face_b] = contact;
    const faces = is_apart(contact) ? near : intersecting;
    if (a === object) faces.add(face_a);
    if (b === object) faces.add(face_b);
  }
  for (const face of intersecting) near.delete(face);
  return { intersecting, near };
}
