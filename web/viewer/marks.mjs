// SPDX-License-Identifier: GPL-3.0-or-later
// Marks on the surfaces in one frame: particles, trails, candidate pairs, contacts.
import { Group } from 'three';
import { marks } from './colours.mjs';
import { faces_of_objects, has_ends, is_apart } from './contacts.mjs';
import { Faces } from './faces.mjs';
import { Segments } from './segments.mjs';
import { Walks } from './walks.mjs';

const trail_frames = 24;

export class Marks {
  /** @param {import('./container.mjs').Page} page @param {import('./places.mjs').Places[]} places  of the objects */
  constructor(page, places) {
    this.page = page;
    this.places = places;
    this.walks = page.objects.map((object) => new Walks(object));
    this.faces = places.map((of_object) => new Faces(of_object, marks.face));
    this.near_faces = places.map((of_object) => new Faces(of_object, marks.near_face));
    this.lines = {
      trails: new Segments(marks.trail, { width: 4, rim_width: 1, hidden: 0.15, order: 30 }),
      candidates: new Segments(marks.candidate, { width: 4, rim_width: 1, hidden: 0.75, order: 32 }),
      near: new Segments(marks.gap, { width: 4, rim_width: 1, hidden: 0.5, order: 28 }),
      segments: new Segments(marks.segment, { width: 5, rim_width: 1.5, hidden: 0.5, order: 34 }),
      particles: new Segments(marks.particle, { width: 11, rim_width: 2, hidden: 0.35, order: 36 }),
    };
    this.group = new Group();
    this.group.add(...Object.values(this.lines).map(({ group }) => group), ...[...this.faces, ...this.near_faces].map(({ group }) => group));
  }

  set_screen(width, height, ratio) {
    Object.values(this.lines).forEach((lines) => lines.set_screen(width, height, ratio));
  }

  /** @param {number} near  distance from the camera at which the picture begins */
  set_near(near) {
    Object.values(this.lines).forEach((lines) => lines.set_near(near));
  }

  /**
   * @param {number} frame  of the page
   * @param {Record<string, boolean>} layers
   * @param {{visible: boolean}[]} objects
   * @returns {Set<number>[]} per object the regions of candidate pairs, if these are shown
   */
  show(frame, layers, objects) {
    for (const [key, lines] of Object.entries(this.lines)) lines.group.visible = layers[key];
    const candidates = this.page.candidates?.[frame] ?? [];
    const paired = objects.map(() => new Set());
    if (layers.candidates)
      for (const [a, p, b, q] of candidates) {
        paired[a].add(p);
        paired[b].add(q);
      }
    const with_particles = this.page.objects.flatMap(({ particles }, i) => (particles && objects[i].visible ? [i] : []));
    if (layers.particles) this.lines.particles.set(with_particles.flatMap((i) => this.#dots(frame, i, paired[i])));
    if (layers.trails) this.lines.trails.set(with_particles.flatMap((i) => this.#trails(frame, i)));
    if (layers.candidates) this.lines.candidates.set(candidates.flatMap((pair) => this.#link(frame, pair, objects)));
    this.#show_contacts(frame, layers, objects);
    return paired;
  }

  #dots(frame, object, paired) {
    return Array.from(this.page.objects[object].particles[frame], (vertex, region) => {
      const place = this.places[object].of_vertex(frame, vertex);
      return { start: place, end: place, tint: paired.has(region) ? marks.paired : undefined };
    });
  }

  /** The recent path of each particle, on the current surface; older parts are fainter. */
  #trails(frame, object) {
    const segments = [];
    const count = this.page.objects[object].particles[frame].length;
    for (let i = 0; i < count; ++i)
      for (let age = 0; age < trail_frames; ++age) {
        const way = this.walks[object].way(frame - age, i);
        if (way.length === 0) break;
        const places = way.map((vertex) => this.places[object].of_vertex(frame, vertex));
        const fade = 0.85 * (1 - age / trail_frames);
        for (let j = 1; j < places.length; ++j) segments.push({ start: places[j - 1], end: places[j], fade: [fade, fade] });
      }
    return segments.reverse();  // The newest is drawn last.
  }

  #link(frame, [a, region_a, b, region_b], objects) {
    const start = this.places[a]?.of_particle(frame, region_a);
    const end = this.places[b]?.of_particle(frame, region_b);
    return start && end && (objects[a].visible || objects[b].visible) ? [{ start, end }] : [];
  }

  #show_contacts(frame, layers, objects) {
    const contacts = this.page.contacts?.[frame] ?? [];
    const found = layers.faces || layers.near ? faces_of_objects(contacts, objects.length) : [];
    objects.forEach(({ visible }, i) => {
      const [faces, near_faces] = [this.faces[i], this.near_faces[i]];
      faces.group.visible = layers.faces && visible;
      near_faces.group.visible = layers.near && visible;
      if (faces.group.visible) faces.show(frame, found[i].intersecting);
      if (near_faces.group.visible) near_faces.show(frame, found[i].near);
    });
    const drawn = contacts.filter((contact) => has_ends(contact) && (objects[contact[0]].visible || objects[contact[2]].visible));
    if (layers.segments) this.lines.segments.set(drawn.filter((contact) => !is_apart(contact)).map((contact) => this.#between_ends(contact)));
    if (layers.near) this.lines.near.set(drawn.filter(is_apart).map((contact) => this.#between_ends(contact)));
  }

  #between_ends(contact) {
    return { start: this.#in_ball(contact.slice(4, 7)), end: this.#in_ball(contact.slice(7, 10)) };
  }

  #in_ball(place) {
    const { centre, radius } = this.places[0].ball;
    return place.map((x, axis) => (x - centre[axis]) / radius);
  }
}
