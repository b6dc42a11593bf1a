// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex normals, recomputed for each frame shown: a few milliseconds for 50 000 triangles.

/**
 * @param {import('./container.mjs').Page_object} object
 * @param {number[]} cell  step lengths of the grid along x, y, z
 * @returns {(q: Uint16Array) => Uint16Array}  positions of a frame -> the normal of each vertex, folded into two bytes
 */
export function vertex_normals({ corners, vertices }, [sx, sy, sz]) {
  const sums = new Float32Array(3 * vertices);
  const folded = new Uint16Array(vertices);
  // A normal is the cross product of two edges; the factors are those of its coordinates.
  const [fx, fy, fz] = [sy * sz, sz * sx, sx * sy].map((f) => f / Math.max(sx, sy, sz, 1e-30) ** 2);
  return (q) => {
    sums.fill(0);
    for (let i = 0; i < corners.length; i += 3) {
      const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
      const ux = q[b] - q[a], uy = q[b + 1] - q[a + 1], uz = q[b + 2] - q[a + 2];
      const vx = q[c] - q[a], vy = q[c + 1] - q[a + 1], vz = q[c + 2] - q[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      sums[a] += x, sums[a + 1] += y, sums[a + 2] += z;
      sums[b] += x, sums[b + 1] += y, sums[b + 2] += z;
      sums[c] += x, sums[c + 1] += y, sums[c + 2] += z;
    }
    for (let v = 0, i = 0; v < vertices; ++v, i += 3) folded[v] = fold(fx * sums[i], fy * sums[i + 1], fz * sums[i + 2]);
    return folded;
  };
}

/** Octahedral encoding: a direction on |x| + |y| + |z| = 1, with the lower half folded over the upper one. */
export function fold(x, y, z) {
  const size = Math.abs(x) + Math.abs(y) + Math.abs(z);
  if (!(size > 0)) return 0x8080;
  let u = x / size, v = y / size;
  if (z < 0) [u, v] = [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)];
  return Math.round((u + 1) * 127.5) | (Math.round((v + 1) * 127.5) << 8);
}
