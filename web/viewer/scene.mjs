// SPDX-License-Identifier: GPL-3.0-or-later
// The picture: surfaces and marks of one frame, with an orbiting camera. Drawn only when something has changed.
import { Box3, Color, MOUSE, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { stage_background } from './colours.mjs';
import { Marks } from './marks.mjs';
import { first_along } from './pick.mjs';
import { common_ball, Places } from './places.mjs';
import { Sharpness } from './sharpness.mjs';
import { Surface } from './surface.mjs';

const field_of_view = 30;
const margin = 1.12;
const nearest_visible = 0.01;  // of the ball's radius; less once the camera is nearer
const view_from = new Vector3(0.55, -1, 0.5).normalize();

/** @param {HTMLCanvasElement} canvas @returns {WebGL2RenderingContext | null} */
export function webgl_of(canvas) {
  try {
    return canvas.getContext('webgl2', { antialias: false, alpha: false, powerPreference: 'high-performance' });
  } catch {
    return null;
  }
}

export class View {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {WebGL2RenderingContext} context
   * @param {import('./container.mjs').Page} page
   * @param {import('./layers.mjs').Shown} shown
   * @param {() => boolean} playing
   */
  constructor(canvas, context, page, shown, playing) {
    this.canvas = canvas;
    this.shown = shown;
    this.stats = { draws: 0, prepare_ms: 0, draw_ms: 0 };
    this.sharpness = new Sharpness(() => playing() || this.held, () => (this.resized = true, this.#draw_soon()));
    const ball = common_ball(page.objects);
    const places = page.objects.map((object) => new Places(object, ball));
    this.samples = places.flatMap((of_object) => [...of_object.samples(400), ...of_object.extremes()]);
    if (this.samples.length === 0) this.samples.push([0, 0, 0]);
    this.surfaces = page.objects.map((object, i) => new Surface(object, i, places[i], page.header.states));
    this.marks = new Marks(page, places);
    this.scene = new Scene();
    this.scene.add(...this.surfaces.map(({ group }) => group), this.marks.group);
    this.renderer = new WebGLRenderer({ canvas, context });
    this.camera = new PerspectiveCamera(field_of_view, 1, nearest_visible, 60);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { enableDamping: false, minDistance: 0.002, maxDistance: 20, maxTargetRadius: 2 });
    this.controls.mouseButtons.MIDDLE = MOUSE.PAN;
    this.controls.addEventListener('change', () => this.#draw_soon());
    this.frame = 0;
    this.stale = true;
    this.moved = this.held = false;
    this.turned = -Infinity;  // when the wheel was
    this.controls.addEventListener('start', () => (this.held = true));
    this.controls.addEventListener('end', () => {
      this.held = false;
      this.#draw_soon();
    });
    canvas.addEventListener('pointermove', ({ movementX, movementY }) => {
      if (!this.held || (movementX === 0 && movementY === 0)) return;  // A click alone does not move it.
      this.moved = true;
      this.#draw_soon();  // The controls do not tell of small changes, which from nearby are large.
    });
    canvas.addEventListener('wheel', (event) => this.#aim(event), { capture: true });  // before the controls
    // three.js makes everything anew, but does not draw by itself.
    canvas.addEventListener('webglcontextrestored', () => this.refresh());
    new ResizeObserver(() => this.#fit()).observe(canvas.parentElement);
    this.#fit();
  }

  /** @param {number} frame  of the page */
  show(frame) {
    if (frame === this.frame && !this.stale) return;
    this.frame = frame;
    this.stale = true;
    this.#draw_soon();
  }

  /** After a change of layers or objects. */
  refresh() {
    this.stale = true;
    this.#draw_soon();
  }

  set_scheme(scheme) {
    this.scene.background = new Color(stage_background[scheme]);
    this.#draw_soon();
  }

  /** The initial camera: from the side and slightly above, at the distance at which all frames just fit. */
  reset() {
    this.moved = false;
    const { camera, controls } = this;
    camera.position.copy(view_from);
    camera.lookAt(0, 0, 0);
    const seen = this.samples.map((place) => new Vector3(...place).applyQuaternion(camera.quaternion.clone().invert()));
    const { min, max } = new Box3().setFromPoints(seen);
    const middle = min.clone().add(max).divideScalar(2);
    const slope = Math.tan((field_of_view * Math.PI) / 360) / margin;
    const needed = (p) => Math.max(Math.abs(p.x - middle.x) / camera.aspect, Math.abs(p.y - middle.y)) / slope + p.z;
    const distance = seen.reduce((most, p) => Math.max(most, needed(p)), max.z + 0.2);
    controls.target.copy(middle).applyQuaternion(camera.quaternion);
    camera.position.set(middle.x, middle.y, distance).applyQuaternion(camera.quaternion);
    controls.update();
    this.#draw_soon();
  }

  /** @param {number} angle  to the left, in radians @param {number} nearer  factor of the distance */
  turn(angle, rise, nearer) {
    const away = this.camera.position.clone().sub(this.controls.target);
    const distance = away.length();
    const elevation = Math.min(1.5, Math.max(-1.5, Math.asin(away.z / distance) + rise));
    const around = Math.atan2(away.y, away.x) + angle;
    away.set(Math.cos(elevation) * Math.cos(around), Math.cos(elevation) * Math.sin(around), Math.sin(elevation));
    this.camera.position.copy(this.controls.target).addScaledVector(away, distance * nearer);
    this.moved = true;
    this.controls.update();
    this.#draw_soon();
  }

  /**
   * @param {number} x @param {number} y  of the window
   * @returns {{distance: number, along: Vector3}} the direction of what is there, and how far away it is; else infinite
   */
  look_at(x, y) {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const { position } = this.camera;
    const along = new Vector3((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height, 0.5).unproject(this.camera).sub(position).normalize();
    const visible = this.surfaces.filter(({ group }) => group.visible);
    const distances = visible.map(({ places }) => first_along(places, this.frame, position, along));
    return { distance: distances.reduce((a, b) => Math.min(a, b), Infinity), along };
  }

  /** The wheel comes nearer to what is under the pointer, which may be in front of or behind the middle. */
  #aim({ deltaY, clientX, clientY, timeStamp }) {
    this.moved = true;
    this.controls.zoomToCursor = deltaY < 0;
    // A turn of the wheel is many events: the camera comes along the same ray, so the first of them aims for all.
    const pause_ms = 100;
    const goes_on = timeStamp - this.turned < pause_ms;
    this.turned = timeStamp;
    if (deltaY >= 0 || goes_on) return;
    const { distance, along } = this.look_at(clientX, clientY);
    if (distance === Infinity) return;
    const forward = this.camera.getWorldDirection(new Vector3());
    this.controls.target.copy(this.camera.position).addScaledVector(forward, distance * forward.dot(along));
  }

  /** Whether drawing has finished. */
  get settled() {
    return this.due === undefined && this.sharpness.settled;
  }

  draw() {
    const begin = performance.now();
    this.sharpness.next_draw(begin);
    if (this.resized) this.#set_size();
    if (this.stale) this.#prepare();
    this.#set_near();
    const prepared = performance.now();
    this.renderer.render(this.scene, this.camera);
    this.stats.draws += 1;
    this.stats.prepare_ms = prepared - begin;
    this.stats.draw_ms = performance.now() - prepared;
  }

  #prepare() {
    this.stale = false;
    const { layers, objects } = this.shown;
    const paired = this.marks.show(this.frame, layers, objects);
    this.surfaces.forEach((surface, i) => {
      surface.set_look(objects[i], layers, this.ratio * 1.1);
      if (!surface.group.visible) return;
      surface.show(this.frame, layers.wireframe);
      surface.mark([...paired[i]]);
    });
  }

  /** Small things in a large scene can be seen from nearby, and the depth buffer is as fine as it can be from afar. */
  #set_near() {
    const near = Math.min(nearest_visible, this.controls.getDistance() / 10);
    if (near === this.camera.near) return;
    this.camera.near = near;
    this.camera.updateProjectionMatrix();
    this.marks.set_near(near);
  }

  #draw_soon() {
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      this.draw();
    });
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.size = [width, height];
    this.resized = true;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.moved) this.reset();
    if (this.stats.draws > 0) this.draw();  // At once, since resizing clears a canvas.
  }

  #set_size() {
    this.resized = false;
    this.stale = true;
    const [width, height] = this.size;
    this.ratio = this.sharpness.ratio(width, height);
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height, false);
    this.marks.set_screen(width, height, this.ratio);
  }
}
