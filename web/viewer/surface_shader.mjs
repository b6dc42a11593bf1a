// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a surface; a vertex is eight bytes.

import { sharp } from './normals.mjs';

/** A row of the palette. It has a colour per region; alpha marks the regions of candidate pairs. */
export const row_length = 256;

// `vertex` holds x, y, z on the object's grid and a normal in two bytes; `regions` those of the face's three corners.
export const vertex_shader = `
precision highp float;
precision highp int;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform mat3 normalMatrix;
uniform vec3 origin, cell;
in uvec4 vertex;
in uvec3 regions;
flat out uvec3 v_regions;
out vec3 v_corner, v_normal, v_view;
out float v_sharp;

vec3 unfolded(uint folded) {
  vec2 p = vec2(folded & 255u, folded >> 8) / 127.5 - 1.0;
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}

void main() {
  int slot = gl_VertexID % 3;
  v_corner = vec3(slot == 0, slot == 1, slot == 2);  // Unspecified where faces share vertices.
  v_regions = regions;
  v_normal = normalMatrix * unfolded(vertex.w);
  v_sharp = vertex.w == ${sharp}u ? 1.0 : 0.0;
  vec4 view = modelViewMatrix * vec4(origin + cell * vec3(vertex.xyz), 1.0);
  v_view = view.xyz;
  gl_Position = projectionMatrix * view;
}
`;

// Regions label vertices; each point of a face takes the region with the largest barycentric weight, as in
// src/region_surface.mjs. The derivatives of the weights give the distance to the border in pixels.
export const fragment_shader = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D palette;
uniform bool coloured, filled, edged;
uniform float opacity, line_width;
uniform vec3 plain, accent;
flat in uvec3 v_regions;
in vec3 v_corner, v_normal, v_view;
in float v_sharp;
out vec4 pixel;

vec4 look(uint region) {
  return texelFetch(palette, ivec2(int(region) % ${row_length}, int(region) / ${row_length}), 0);
}

vec3 region_paint() {
  uvec3 r = v_regions;
  if (r.x == r.y && r.y == r.z) return look(r.x).rgb;
  vec3 c = v_corner;
  vec3 weight = vec3(
    c.x + (r.y == r.x ? c.y : 0.0) + (r.z == r.x ? c.z : 0.0),
    r.y == r.x ? 0.0 : c.y + (r.z == r.y ? c.z : 0.0),
    r.z == r.x || r.z == r.y ? 0.0 : c.z);
  float most = max(weight.x, max(weight.y, weight.z));
  int top = weight.x == most ? 0 : weight.y == most ? 1 : 2;
  vec3 across = dFdx(weight), down = dFdy(weight);
  vec3 steep_x = vec3(across[top]) - across, steep_y = vec3(down[top]) - down;
  vec3 away = (vec3(most) - weight) / max(sqrt(steep_x * steep_x + steep_y * steep_y), vec3(1e-9));
  away[top] = 1e9;
  int other = away.x < away.y ? (away.x < away.z ? 0 : 2) : (away.y < away.z ? 1 : 2);
  vec4 own = look(r[top]), beside = look(r[other]);
  bool marked = own.a > 0.5 || beside.a > 0.5;
  float width = marked ? 2.2 * line_width : line_width;
  float line = 1.0 - smoothstep(width - 0.5, width + 0.5, away[other]);
  return mix(own.rgb, marked ? accent : own.rgb * 0.25, line);
}

/** Coverage by an edge of the triangle; fades where triangles are only a few pixels high. */
float edge() {
  vec3 slope = fwidth(v_corner);
  vec3 away = v_corner / max(slope, vec3(1e-9));
  float line = 1.0 - smoothstep(0.25 * line_width, 0.25 * line_width + 0.9, min(away.x, min(away.y, away.z)));
  return line * smoothstep(2.0, 10.0, 1.0 / max(slope.x, max(slope.y, slope.z)));
}

void main() {
  float line = edged ? edge() : 0.0;
  if (!filled && line < 0.02) discard;
  vec3 normal = normalize(gl_FrontFacing ? v_normal : -v_normal);
  if (v_sharp > 0.0) normal = normalize(cross(dFdx(v_view), dFdy(v_view)));  // A corner of the face is sharp.
  vec3 to_eye = normalize(-v_view);
  vec3 to_lamp = normalize(vec3(-0.35, 0.6, 0.75));
  vec3 paint = coloured ? region_paint() : plain;
  float light = 0.40 + 0.12 * normal.y + 0.66 * max(0.0, dot(normal, to_lamp));
  float shine = pow(max(0.0, dot(normal, normalize(to_lamp + to_eye))), 40.0);
  vec3 colour = paint * light * (gl_FrontFacing ? 1.0 : 0.7) + 0.06 * shine;
  colour = pow(clamp(colour, 0.0, 1.0), vec3(1.0 / 2.2));
  pixel = filled ? vec4(mix(colour, vec3(0.04), 0.55 * line), opacity) : vec4(colour, line);
}
`;
