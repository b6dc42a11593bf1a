// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in the browser that takes the pictures.
import {
  AmbientLight, BasicShadowMap, Box3, Color, DirectionalLight, FloatType, LinearSRGBColorSpace, Mesh, MeshLambertMaterial,
  PerspectiveCamera, PlaneGeometry, Quaternion, Scene, Vector3, WebGLRenderer, WebGLRenderTarget,
} from 'three';
import { region_geometry, region_material } from './region_surface.mjs';

// A picture is the mean of several passes. Each pass has another lamp position, other sky lights and a subpixel camera
// offset: this gives soft shadows, dark creases and smooth edges.
const passes = 24;
const skies = 3;
const background = new Color('#f3f4f6');
const lamp_direction = new Vector3(-0.25, -0.7, 0.95).normalize();
const lamp_spread = 0.3;
const lamp_strength = 2;
const sky_strength = 2.5;
const sky_spread = 0.93;  // Light from the horizon would cast long streaks on the ground.
const fill_strength = 0.25;
const shadow_depth = 0.5;
const view_from = new Vector3(0.62, -1, 0.55).normalize();
const field_of_view = 26;
const margin = 1.1;
const aspect = 5 / 4;

const renderer = new WebGLRenderer({ antialias: false });
renderer.outputColorSpace = LinearSRGBColorSpace;
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = BasicShadowMap;

/** Deterministic points, evenly distributed in the unit square. */
const even_point = (i) => [((i + 0.5) * 0.7548776662466927) % 1, ((i + 0.5) * 0.5698402909980532) % 1];

/** Directions around the vertical, cosine-weighted for level ground; `spread` is the sine of the widest angle. */
function upward([u, v], spread) {
  const r = spread * Math.sqrt(u);
  return new Vector3(r * Math.cos(2 * Math.PI * v), r * Math.sin(2 * Math.PI * v), Math.sqrt(1 - r * r));
}

const to_lamp = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), lamp_direction);

/** Directions to the lamp and the sky lights in a pass. */
function light_directions(pass) {
  const lamp = upward(even_point(pass), lamp_spread).applyQuaternion(to_lamp);
  const sky = Array.from({ length: skies }, (_, i) => upward(even_point(pass * skies + i), sky_spread));
  return [lamp, ...sky];
}

function shadow_light(strength) {
  const light = new DirectionalLight(0xffffff, strength);
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  // The mesh is inside the unit ball; its shadow on the ground is limited to the shadow map.
  Object.assign(light.shadow.camera, { left: -1.5, right: 1.5, top: 1.5, bottom: -1.5, near: 0.5, far: 8 });
  light.shadow.normalBias = 0.012;
  light.shadow.bias = -0.0008;
  return light;
}

/** A ground as bright as the background where it is unshaded, and slightly darker in shadows. */
function ground(height, lights) {
  const material = new MeshLambertMaterial({ color: background.clone().multiplyScalar((shadow_depth * Math.PI) / brightness(lights)) });
  material.emissive = background.clone().multiplyScalar(1 - shadow_depth);
  const plane = new Mesh(new PlaneGeometry(200, 200), material);
  plane.position.z = height - 0.01;  // A flat mesh must not coincide with it.
  plane.receiveShadow = true;
  return plane;
}

/** Mean illumination of unshaded level ground over all passes. */
function brightness(lights) {
  let sum = 0;
  for (let pass = 0; pass < passes; ++pass)
    light_directions(pass).forEach((direction, i) => (sum += lights[i].intensity * direction.z));
  return fill_strength + sum / passes;
}

/** A camera from the side and above, at the distance at which the mesh just fits. */
function fitted_camera(positions) {
  const camera = new PerspectiveCamera(field_of_view, aspect, 0.05, 100);
  camera.up.set(0, 0, 1);
  camera.position.copy(view_from);
  camera.lookAt(0, 0, 0);
  const to_view = camera.quaternion.clone().invert();
  const points = [];
  for (let i = 0; i < positions.length; i += 3) points.push(new Vector3().fromArray(positions, i).applyQuaternion(to_view));
  const { min, max } = new Box3().setFromPoints(points);
  const middle = min.add(max).divideScalar(2);
  const slope = Math.tan((field_of_view * Math.PI) / 360) / margin;
  const needed = (p) => Math.max(Math.abs(p.x - middle.x) / aspect, Math.abs(p.y - middle.y)) / slope + p.z;
  const distance = points.reduce((most, p) => Math.max(most, needed(p)), 0);
  camera.position.set(middle.x, middle.y, distance).applyQuaternion(camera.quaternion);
  return camera;
}

function add_pass(sum, target, buffer) {
  renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, buffer);
  for (let i = 0; i < sum.length; ++i) sum[i] += buffer[i];
}

/** The mean of the passes on a canvas. Passes are in linear light, with the lowest row first. */
function to_canvas(sum, width, height) {
  const image = new ImageData(width, height);
  const curve = (x) => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
  const row_length = 4 * width;
  image.data.forEach((_, i) => {
    const from = row_length * (height - 1 - Math.floor(i / row_length)) + (i % row_length);
    image.data[i] = i % 4 === 3 ? 255 : Math.round(255 * curve(Math.min(1, sum[from] / passes)));
  });
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d', { alpha: false }).putImageData(image, 0, 0);
  return canvas;
}

function render(mesh, width, height) {
  const scene = new Scene();
  scene.background = background;
  const surface = new Mesh(region_geometry(mesh), region_material(width / 800));
  surface.castShadow = surface.receiveShadow = true;
  const lowest = mesh.positions.reduce((least, z, i) => (i % 3 === 2 ? Math.min(least, z) : least), Infinity);
  const lights = [lamp_strength, ...Array(skies).fill(sky_strength / skies)].map(shadow_light);
  scene.add(surface, ground(lowest, lights), ...lights, new AmbientLight(0xffffff, fill_strength));
  const camera = fitted_camera(mesh.positions);
  const target = new WebGLRenderTarget(width, height, { type: FloatType });
  const sum = new Float32Array(4 * width * height);
  const buffer = new Float32Array(4 * width * height);
  renderer.setRenderTarget(target);
  for (let i = 0; i < passes; ++i) {
    light_directions(i).forEach((direction, j) => lights[j].position.copy(direction).multiplyScalar(4));
    const [x, y] = even_point(i);
    camera.setViewOffset(width, height, x - 0.5, y - 0.5, width, height);
    renderer.render(scene, camera);
    add_pass(sum, target, buffer);
  }
  [surface.geometry, surface.material, target, ...lights].forEach((resource) => resource.dispose());
  return to_canvas(sum, width, height);
}

/** All pictures taken so far, with their names below. */
function sheet_of(pictures, columns) {
  const [width, gap, label_height] = [400, 16, 40];
  const height = Math.round(width / aspect);
  const rows = Math.ceil(pictures.length / columns);
  const across = gap + (width + gap) * Math.min(columns, pictures.length);
  const canvas = new OffscreenCanvas(across, gap + (height + label_height) * rows);
  const context = canvas.getContext('2d', { alpha: false });
  context.fillStyle = 'white';
  context.fillRect(0, 0, canvas.width, canvas.height);
  Object.assign(context, { fillStyle: '#24292f', font: '16px "DejaVu Sans", sans-serif', textAlign: 'center', imageSmoothingQuality: 'high' });
  pictures.forEach(({ canvas: picture, label }, i) => {
    const x = gap + (width + gap) * (i % columns);
    const y = gap + (height + label_height) * Math.floor(i / columns);
    context.drawImage(picture, x, y, width, height);
    context.fillText(label, x + width / 2, y + height + 22, width);
  });
  return canvas;
}

async function png(canvas) {
  const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
  let text = '';
  // In chunks, because of the limit on arguments per call.
  for (let i = 0; i < bytes.length; i += 0x8000) text += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(text);
}

function decode(text, Type) {
  return new Type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
}

const taken = [];

/** @returns {Promise<string>} a PNG in base64, like all data between this page and the program */
globalThis.take_picture = ({ encoded, label, width }) => {
  const mesh = {
    positions: decode(encoded.positions, Float32Array),
    colours: decode(encoded.colours, Float32Array),
    regions: decode(encoded.regions, Int32Array),
    faces: decode(encoded.faces, Uint32Array),
  };
  const canvas = render(mesh, width, Math.round(width / aspect));
  taken.push({ canvas, label });
  return png(canvas);
};

globalThis.take_sheet = (columns) => png(sheet_of(taken, columns));
