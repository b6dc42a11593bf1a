// SPDX-License-Identifier: GPL-3.0-or-later
// Lines and dots with a width in pixels, round ends and a rim; faint where a surface hides them.
import {
  DynamicDrawUsage, GLSL3, Group, InstancedBufferAttribute, InstancedBufferGeometry, Mesh, RawShaderMaterial, Vector2,
} from 'three';

// Depth is offset slightly towards the eye, so that a mark on a surface is not hidden by it.
const vertex_shader = `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec2 screen;
uniform float width, near;
in vec3 start, end, tint;
in vec2 fade;
out vec3 v_tint;
out vec2 v_place, v_fade;
out float v_length;

void main() {
  vec4 a = modelViewMatrix * vec4(start, 1.0), b = modelViewMatrix * vec4(end, 1.0);
  a.xyz *= 0.995;
  b.xyz *= 0.995;
  if (a.z > -near && b.z < -near) a = mix(b, a, (b.z + near) / (b.z - a.z));
  if (b.z > -near && a.z < -near) b = mix(a, b, (a.z + near) / (a.z - b.z));
  vec4 clip_a = projectionMatrix * a, clip_b = projectionMatrix * b;
  vec3 from = clip_a.xyz / clip_a.w, to = clip_b.xyz / clip_b.w;
  vec2 along = (to.xy - from.xy) * 0.5 * screen;
  v_length = length(along);
  along = v_length > 1e-3 ? along / v_length : vec2(1.0, 0.0);
  bool last = gl_VertexID > 1;
  float reach = 0.5 * width + 1.0, side = gl_VertexID % 2 == 0 ? -reach : reach;
  v_place = vec2(last ? v_length + reach : -reach, side);
  v_tint = tint;
  v_fade = fade;
  vec2 offset = along * (last ? reach : -reach) + vec2(-along.y, along.x) * side;
  vec3 corner = last ? to : from;
  bool behind = a.z > -near && b.z > -near;
  gl_Position = behind ? vec4(2.0, 2.0, 2.0, 1.0) : vec4(corner.xy + offset * 2.0 / screen, corner.z, 1.0);
}
`;

const fragment_shader = `
precision highp float;
uniform float width, rim_width, opacity;
uniform vec3 rim;
in vec3 v_tint;
in vec2 v_place, v_fade;
in float v_length;
out vec4 pixel;

void main() {
  float along = clamp(v_place.x, 0.0, v_length);
  float away = length(v_place - vec2(along, 0.0));
  float cover = 1.0 - smoothstep(0.5 * width - 0.5, 0.5 * width + 0.5, away);
  float core = 0.5 * width - rim_width;
  vec3 colour = mix(v_tint, rim, smoothstep(core - 0.5, core + 0.5, away));
  float strength = mix(v_fade.x, v_fade.y, v_length > 0.0 ? along / v_length : 0.0);
  pixel = vec4(colour, cover * opacity * strength);
  if (pixel.a < 0.004) discard;
}
`;

/** @typedef {{start: number[], end: number[], tint?: number[], fade?: [number, number]}} Segment  a dot, where the ends are one */

export class Segments {
  /**
   * @param {{core: number[], rim: number[]}} colours
   * @param {{width: number, rim_width: number, hidden: number, order: number}} look  pixels; opacity where a surface
   * hides it
   */
  constructor({ core, rim }, { width, rim_width, hidden, order }) {
    this.core = core;
    this.sizes = { width, rim_width };
    this.uniforms = { screen: { value: new Vector2() }, near: { value: 0.01 }, width: { value: 1 }, rim_width: { value: 1 }, rim: { value: rim } };
    this.geometry = geometry_of(64);
    this.group = new Group();
    if (hidden > 0) this.group.add(this.#mesh(hidden, false, order));
    this.group.add(this.#mesh(1, true, order + 1));
  }

  /** @param {Segment[]} segments  to draw instead of the previous ones */
  set(segments) {
    if (segments.length > this.geometry.attributes.start.count) this.#grow(segments.length);
    const { start, end, tint, fade } = this.geometry.attributes;
    segments.forEach((segment, i) => {
      start.setXYZ(i, ...segment.start);
      end.setXYZ(i, ...segment.end);
      tint.setXYZ(i, ...(segment.tint ?? this.core));
      fade.setXY(i, ...(segment.fade ?? [1, 1]));
    });
    this.geometry.instanceCount = segments.length;
    this.group.children.forEach((mesh) => (mesh.visible = segments.length > 0));
    [start, end, tint, fade].forEach((attribute) => (attribute.needsUpdate = true));
  }

  /** @param {number} ratio  pixels of the screen per pixel of the page */
  set_screen(width, height, ratio) {
    this.uniforms.screen.value.set(width * ratio, height * ratio);
    const smaller = Math.min(1, Math.max(0.7, Math.min(width, height) / 560));  // on a phone
    for (const [name, size] of Object.entries(this.sizes)) this.uniforms[name].value = size * ratio * smaller;
  }

  /** @param {number} near  distance from the camera at which the picture begins */
  set_near(near) {
    this.uniforms.near.value = near;
  }

  #grow(count) {
    this.geometry.dispose();
    this.geometry = geometry_of(2 * count);
    this.group.children.forEach((mesh) => (mesh.geometry = this.geometry));
  }

  #mesh(opacity, tested, order) {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: vertex_shader,
      fragmentShader: fragment_shader,
      uniforms: { ...this.uniforms, opacity: { value: opacity } },
      transparent: true,
      depthWrite: false,
      depthTest: tested,
    });
    const mesh = new Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
    return mesh;
  }
}

function geometry_of(capacity) {
  const geometry = new InstancedBufferGeometry();
  geometry.setIndex([0, 2, 1, 1, 2, 3]);
  for (const [name, size] of [['start', 3], ['end', 3], ['tint', 3], ['fade', 2]])
    geometry.setAttribute(name, new InstancedBufferAttribute(new Float32Array(size * capacity), size).setUsage(DynamicDrawUsage));
  geometry.instanceCount = 0;
  return geometry;
}
