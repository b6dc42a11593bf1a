// SPDX-License-Identifier: GPL-3.0-or-later
// Vertex normals, recomputed for each frame shown: a few milliseconds for 50 000 triangles.

/** In place of a normal to which some face of the vertex is inclined by more than 40 degrees: its faces are drawn flat. */
export const sharp = 0xffff;
const least_cosine = Math.cos((40 * Math.PI) / 180);

/**
 * @param {import('./container.mjs').Page_object} object
 * @param {number[]} cell  step lengths of the grid along x, y, z
 * @returns {(q: Uint16Array) => Uint16Array}  positions of a frame -> the normal of each vertex, folded into two bytes
 */
export function vertex_normals({ corners, vertices }, [sx, sy, sz]) {
  const sums = new Float32Array(3 * vertices);
  const folded = new Uint16Array(vertices);
  const of_faces = new Float32Array(corners.length);
  // A normal is the cross product of two edges; the factors are those of its coordinates.
  const [fx, fy, fz] = [sy * sz, sz * sx, sx * sy].map((f) => f / Math.max(sx, sy, sz, 1e-30) ** 2);
  return (q) => {
    sums.fill(0);
    for (let i = 0; i < corners.length; i += 3) {
      const a = 3 * corners[i], b = 3 * corners[i + 1], c = 3 * corners[i + 2];
      const ux = q[b] - q[a], uy = q[b + 1] - q[a + 1], uz = q[b + 2] - q[a + 2];
      const vx = q[c] - q[a], vy = q[c + 1] - q[a + 1], vz = q[c + 2] - q[a + 2];
      const x = fx * (uy * vz - uz * vy), y = fy * (uz * vx - ux * vz), z = fz * (ux * vy - uy * vx);
      of_faces[i] = x, of_faces[i + 1] = y, of_faces[i + 2] = z;
      sums[a] += x, sums[a + 1] += y, sums[a + 2] += z;
      sums[b] += x, sums[b + 1] += y, sums[b + 2] += z;
      sums[c] += x, sums[c + 1] += y, sums[c + 2] += z;
    }
    for (let v = 0, i = 0; v < vertices; ++v, i += 3) folded[v] = fold(sums[i], sums[i + 1], sums[i + 2]);
    for (let i = 0; i < corners.length; i += 3) {
      const x = of_faces[i], y = of_faces[i + 1], z = of_faces[i + 2];
      const size = Math.sqrt(x * x + y * y + z * z);
      for (let j = i; j < i + 3; ++j) {
        const s = 3 * corners[j];
        const nx = sums[s], ny = sums[s + 1], nz = sums[s + 2];
        const length = Math.sqrt(nx * nx + ny * ny + nz * nz);
        if (x * nx + y * ny + z * nz < least_cosine * size * length) folded[corners[j]] = sharp;
      }
    }
    return folded;
  };
}

/** Octahedral encoding: a direction on |x| + |y| + |z| = 1, with the lower half folded over the upper one. Never `sharp`. */
export function fold(x, y, z) {
  const size = Math.abs(x) + Math.abs(y) + Math.abs(z);
  if (!(size > 0)) return 0x8080;
  let u = x / size, v = y / size;
  if (z < 0) [u, v] = [(1 - Math.abs(v)) * (u < 0 ? -1 : 1), (1 - Math.abs(u)) * (v < 0 ? -1 : 1)];
  const folded = Math.round((u + 1) * 127.5) | (Math.round((v + 1) * 127.5) << 8);
  return folded === sharp ? 0 : folded;  // All four corners are the same direction.
}
