// SPDX-License-Identifier: GPL-3.0-or-later
// One object's surface in the scene.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, DynamicDrawUsage, GLSL3, Group, IntType, Mesh, RawShaderMaterial, RGBAFormat,
  SRGBColorSpace, UnsignedByteType, Vector3,
} from 'three';
import { marks, object_colour, region_colour, state_colour } from './colours.mjs';
import { vertex_normals } from './normals.mjs';
import { fragment_shader, row_length, vertex_shader } from './surface_shader.mjs';

/**
 * Most faces are inside a region: they share their vertices, and a new frame is an upload of eight bytes per vertex.
 * Faces on a border, and all faces in wireframe mode, must tell their three corners apart, so their vertices are
 * copied.
 */
export class Surface {
  /**
   * @param {import('./container.mjs').Page_object} object
   * @param {number} index  of the object on the page
   * @param {import('./places.mjs').Places} places
   */
  constructor(object, index, places, states) {
    this.object = object;
    this.places = places;
    this.normals = vertex_normals(object, places.cell);
    this.vertices = new Uint16Array(4 * object.vertices);
    this.partition = undefined;
    this.apart = undefined;
    this.marked = [];
    this.label_colour = states ? state_colour : region_colour;
    this.material = material_of({
      palette: palette_of(1, this.label_colour),
      origin: new Vector3(...places.origin),
      cell: new Vector3(...places.cell),
      plain: new Color().setRGB(...object_colour(index).map((x) => x / 255), SRGBColorSpace),
    });
    this.shared = this.#mesh(geometry_of(object.vertices, this.vertices));
    this.shared.geometry.setIndex(new BufferAttribute(new Uint32Array(3 * object.triangles), 1));
    this.copied = this.#mesh(geometry_of(0));
    this.corners = new Uint32Array(0);
    this.group = new Group();
    this.group.add(this.shared, this.copied);
  }

  /** @param {number} frame  of the page @param {boolean} apart  whether each face must tell its corners apart */
  show(frame, apart) {
    const partition = this.places.partition(frame);
    if (partition !== this.partition || apart !== this.apart) this.#arrange(partition, apart);
    const q = this.object.frames[frame];
    const normals = this.normals(q);
    for (let v = 0, from = 0, to = 0; v < normals.length; ++v) {
      this.vertices[to++] = q[from++];
      this.vertices[to++] = q[from++];
      this.vertices[to++] = q[from++];
      this.vertices[to++] = normals[v];
    }
    this.shared.geometry.attributes.vertex.needsUpdate = true;
    const { vertex } = this.copied.geometry.attributes;
    copy_entries(this.vertices, this.corners, vertex.array);
    vertex.needsUpdate = true;
  }

  /** @param {number[]} regions  whose borders stand out */
  mark(regions) {
    const palette = this.material.uniforms.palette.value;
    this.marked.forEach((region) => (palette.image.data[4 * region + 3] = 0));
    this.marked = regions.filter((region) => this.partition && region < this.partition.regions);
    this.marked.forEach((region) => (palette.image.data[4 * region + 3] = 255));
    palette.needsUpdate = true;
  }

  /**
   * @param {{visible: boolean, translucent: boolean}} state  of the object
   * @param {Record<string, boolean>} layers
   * @param {number} line_width  in pixels of the screen
   */
  set_look({ visible, translucent }, layers, line_width) {
    this.group.visible = visible && (layers.surfaces || layers.wireframe);
    const { uniforms } = this.material;
    uniforms.coloured.value = layers.regions && this.object.partitions.length > 0;
    uniforms.filled.value = layers.surfaces;
    uniforms.edged.value = layers.wireframe;
    uniforms.opacity.value = translucent ? 0.3 : 1;
    uniforms.line_width.value = line_width;
    this.material.transparent = translucent || !layers.surfaces;
    this.material.depthWrite = !this.material.transparent;
  }

  /** Divides the faces into those that share their vertices and those that do not, for a partition. */
  #arrange(partition, apart) {
    const { corners, vertices } = this.object;
    const label = (vertex) => partition?.labels[vertex] ?? 0;
    const index = this.shared.geometry.index;
    const copied = [];
    let shared = 0;
    for (let i = 0; i < corners.length; i += 3) {
      const own = label(corners[i]);
      if (apart || label(corners[i + 1]) !== own || label(corners[i + 2]) !== own) copied.push(corners[i], corners[i + 1], corners[i + 2]);
      else for (let j = i; j < i + 3; ++j) index.array[shared++] = corners[j];
    }
    index.needsUpdate = true;
    this.shared.geometry.setDrawRange(0, shared);
    const { regions } = this.shared.geometry.attributes;
    for (let v = 0; v < vertices; ++v) regions.array.fill(label(v), 3 * v, 3 * v + 3);
    regions.needsUpdate = true;
    this.#copy(Uint32Array.from(copied), label);
    this.shared.visible = shared > 0;  // Empty meshes would be drawn too.
    this.copied.visible = copied.length > 0;
    if (partition !== this.partition) this.#set_palette(partition?.regions ?? 1);
    Object.assign(this, { partition, apart });
  }

  #copy(corners, label) {
    this.corners = corners;
    this.copied.geometry.dispose();
    this.copied.geometry = geometry_of(corners.length);
    this.copied.geometry.setDrawRange(0, corners.length);
    const regions = this.copied.geometry.attributes.regions.array;
    for (let i = 0; i < corners.length; ++i) for (let j = 0; j < 3; ++j) regions[3 * i + j] = label(corners[i - (i % 3) + j]);
  }

  #set_palette(regions) {
    this.material.uniforms.palette.value.dispose();
    this.material.uniforms.palette.value = palette_of(regions, this.label_colour);
    this.marked = [];
  }

  #mesh(geometry) {
    const mesh = new Mesh(geometry, this.material);
    mesh.frustumCulled = false;  // three.js does not know its box.
    return mesh;
  }
}

function geometry_of(count, vertices = new Uint16Array(4 * count)) {
  const geometry = new BufferGeometry();
  for (const [name, values, size] of [['vertex', vertices, 4], ['regions', new Uint32Array(3 * count), 3]]) {
    const attribute = new BufferAttribute(values, size).setUsage(DynamicDrawUsage);
    attribute.gpuType = IntType;
    geometry.setAttribute(name, attribute);
  }
  return geometry;
}

/** Entries of eight bytes, two words at a time. */
function copy_entries(from, which, to) {
  const [source, target] = [from, to].map(({ buffer }) => new Uint32Array(buffer));
  for (let i = 0; i < which.length; ++i) {
    target[2 * i] = source[2 * which[i]];
    target[2 * i + 1] = source[2 * which[i] + 1];
  }
}

function material_of(values) {
  const defaults = { coloured: true, filled: true, edged: false, opacity: 1, line_width: 1, accent: new Color(...marks.paired) };
  return new RawShaderMaterial({
    glslVersion: GLSL3,
    vertexShader: vertex_shader,
    fragmentShader: fragment_shader,
    uniforms: Object.fromEntries(Object.entries({ ...defaults, ...values }).map(([name, value]) => [name, { value }])),
    side: DoubleSide,
  });
}

function palette_of(regions, colour) {
  const rows = Math.max(1, Math.ceil(regions / row_length));
  const texture = new DataTexture(new Uint8Array(4 * rows * row_length), row_length, rows, RGBAFormat, UnsignedByteType);
  texture.colorSpace = SRGBColorSpace;
  for (let region = 0; region < regions; ++region) texture.image.data.set(colour(region), 4 * region);
  texture.needsUpdate = true;
  return texture;
}
