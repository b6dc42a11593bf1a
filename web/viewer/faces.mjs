// SPDX-License-Identifier: GPL-3.0-or-later
// Some faces of one object: in one colour, with dark edges, faint where a surface hides them.
import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, GLSL3, Group, Mesh, RawShaderMaterial } from 'three';

const vertex_shader = `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 position;
out vec3 v_corner, v_view;
void main() {
  int slot = gl_VertexID % 3;
  v_corner = vec3(slot == 0, slot == 1, slot == 2);
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  v_view = view.xyz;
  view.xyz *= 0.9985;
  gl_Position = projectionMatrix * view;
}
`;

const fragment_shader = `
precision highp float;
uniform vec3 colour, rim;
uniform float opacity;
in vec3 v_corner, v_view;
out vec4 pixel;
void main() {
  vec3 away = v_corner / max(fwidth(v_corner), vec3(1e-9));
  float inside = smoothstep(0.6, 1.6, min(away.x, min(away.y, away.z)));
  float light = 0.75 + 0.35 * abs(normalize(cross(dFdx(v_view), dFdy(v_view))).z);
  pixel = vec4(mix(rim, colour * light, inside), opacity);
}
`;

export class Faces {
  /**
   * @param {import('./places.mjs').Places} places  of the object
   * @param {{core: number[], rim: number[]}} colours
   */
  constructor(places, { core, rim }) {
    this.places = places;
    this.colours = { colour: { value: core }, rim: { value: rim } };
    this.geometry = geometry_of(64);
    this.group = new Group();
    this.group.add(this.#mesh(0.22, false, 20), this.#mesh(1, true, 5));
  }

  /** @param {number} frame  of the page @param {Iterable<number>} faces  of the object */
  show(frame, faces) {
    const { corners } = this.places.object;
    const list = [...faces];
    this.group.children.forEach((mesh) => (mesh.visible = list.length > 0));
    if (list.length === 0) return;
    if (3 * list.length > this.geometry.attributes.position.count) this.#grow(3 * list.length);
    const { position } = this.geometry.attributes;
    list.forEach((face, i) => {
      for (let j = 0; j < 3; ++j) position.setXYZ(3 * i + j, ...this.places.of_vertex(frame, corners[3 * face + j]));
    });
    position.needsUpdate = true;
    this.geometry.setDrawRange(0, 3 * list.length);
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
      uniforms: { ...this.colours, opacity: { value: opacity } },
      side: DoubleSide,
      forceSinglePass: true,
      transparent: opacity < 1,
      depthTest: tested,
      depthWrite: tested,
    });
    const mesh = new Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = order;
    return mesh;
  }
}

function geometry_of(corners) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * corners), 3).setUsage(DynamicDrawUsage));
  geometry.setDrawRange(0, 0);
  return geometry;
}
