// SPDX-License-Identifier: GPL-3.0-or-later
// What is under the pointer.

/**
 * How far along a ray its first face is, as a multiple of the ray's direction. Tries all faces.
 * @param {import('./places.mjs').Places} places  of the object
 * @param {number} frame  of the page
 * @param {{x: number, y: number, z: number}} from
 * @param {{x: number, y: number, z: number}} along
 * @returns {number} infinite, if it meets none
 */
export function first_along({ object, origin, cell }, frame, from, along) {
  const [q, { corners }] = [object.frames[frame], object];
  const [ox, oy, oz] = [origin[0] - from.x, origin[1] - from.y, origin[2] - from.z];
  const [sx, sy, sz] = cell;
  let nearest = Infinity;
  for (let i = 0; i < corners.length; i += 3) {
    const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
    const ax = ox + sx * q[a], ay = oy + sy * q[a + 1], az = oz + sz * q[a + 2];
    const ux = sx * (q[b] - q[a]), uy = sy * (q[b + 1] - q[a + 1]), uz = sz * (q[b + 2] - q[a + 2]);
    const vx = sx * (q[c] - q[a]), vy = sy * (q[c + 1] - q[a + 1]), vz = sz * (q[c + 2] - q[a + 2]);
    const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const slope = nx * along.x + ny * along.y + nz * along.z;
    const at = (nx * ax + ny * ay + nz * az) / slope;
    if (!(at > 0 && at < nearest)) continue;
    const px = at * along.x - ax, py = at * along.y - ay, pz = at * along.z - az;
    // Parts of the area, by Cramer's rule: p = s u + t v.
    const size = nx * nx + ny * ny + nz * nz;
    const s = (nx * (py * vz - pz * vy) + ny * (pz * vx - px * vz) + nz * (px * vy - py * vx)) / size;
    const t = (nx * (uy * pz - uz * py) + ny * (uz * px - ux * pz) + nz * (ux * py - uy * px)) / size;
    if (s >= 0 && t >= 0 && s + t <= 1) nearest = at;
  }
  return nearest;
}
