// SPDX-License-Identifier: GPL-3.0-or-later
// A surface with a flat colour per region and sharp borders, for three.js.
import { BufferAttribute, BufferGeometry, DoubleSide, MeshPhongMaterial } from 'three';
import { toCreasedNormals } from 'three/addons/utils/BufferGeometryUtils.js';

const sharp_edge = (40 * Math.PI) / 180;

/**
 * Regions label vertices, so a face can belong to three. Each point takes the colour of the region with the largest
 * weight, the sum of the barycentric coordinates of the region's corners. The border of two regions is then a straight
 * line between midpoints of edges, three borders meet in the centroid, and no face needs to be split.
 *
 * @param {import('./coloured_ply.mjs').Coloured_mesh} mesh
 */
export function region_geometry({ positions, colours, regions, faces }) {
  const geometry = corners_with_normals(positions, faces);
  const weights = new Float32Array(3 * faces.length);
  const corner_colours = [0, 1, 2].map(() => new Float32Array(3 * faces.length));
  for (let face = 0; face < faces.length; face += 3) {
    const corners = faces.subarray(face, face + 3);
    const labels = Array.from(corners, (vertex) => regions[vertex]);
    for (let i = 0; i < 3; ++i) {
      weights[3 * (face + i) + labels.indexOf(labels[i])] = 1;
      corners.forEach((vertex, slot) => corner_colours[slot].set(colours.subarray(3 * vertex, 3 * vertex + 3), 3 * (face + i)));
    }
  }
  geometry.setAttribute('weight', new BufferAttribute(weights, 3));
  corner_colours.forEach((values, slot) => geometry.setAttribute(`colour_${slot}`, new BufferAttribute(values, 3)));
  return geometry;
}

function corners_with_normals(positions, faces) {
  const indexed = new BufferGeometry();
  indexed.setAttribute('position', new BufferAttribute(positions.slice(), 3));
  indexed.setIndex(new BufferAttribute(faces, 1));
  // three.js would join vertices within a hundredth of a unit.
  const larger = 1e5;
  const geometry = toCreasedNormals(indexed.scale(larger, larger, larger), sharp_edge);
  return geometry.scale(1 / larger, 1 / larger, 1 / larger);
}

const declarations = `
varying vec3 v_weight;
varying vec3 v_colour_0;
varying vec3 v_colour_1;
varying vec3 v_colour_2;
`;

const to_varyings = `
v_weight = weight;
v_colour_0 = colour_0;
v_colour_1 = colour_1;
v_colour_2 = colour_2;
`;

// The weights are linear on a face, so their derivatives give the distance to the border in pixels.
const paint = `
float most = max(v_weight.x, max(v_weight.y, v_weight.z));
vec3 behind = vec3(most) - v_weight;
bool first = v_weight.x == most;
bool second = !first && v_weight.y == most;
diffuseColor.rgb = mix(vec3(0.85), first ? v_colour_0 : second ? v_colour_1 : v_colour_2, 0.93);
vec3 across = dFdx(v_weight);
vec3 down = dFdy(v_weight);
vec3 top_across = vec3(first ? across.x : second ? across.y : across.z);
vec3 top_down = vec3(first ? down.x : second ? down.y : down.z);
vec3 steepness = sqrt((top_across - across) * (top_across - across) + (top_down - down) * (top_down - down));
vec3 distances = behind / max(steepness, vec3(1e-9));
if (first) distances.x = 1e9; else if (second) distances.y = 1e9; else distances.z = 1e9;
if (min(distances.x, min(distances.y, distances.z)) < border_width) diffuseColor.rgb *= border_shade;
`;

/** @param {number} border_width  half the width of the line between two regions, in pixels */
export function region_material(border_width) {
  const material = new MeshPhongMaterial({ specular: 0x1c1c1c, shininess: 24, side: DoubleSide });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.border_width = { value: border_width };
    shader.uniforms.border_shade = { value: 0.12 };
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\nattribute vec3 weight, colour_0, colour_1, colour_2;${declarations}`)
      .replace('#include <begin_vertex>', `#include <begin_vertex>${to_varyings}`);
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', `#include <common>\nuniform float border_width, border_shade;${declarations}`)
      .replace('#include <color_fragment>', paint);
  };
  return material;
}
