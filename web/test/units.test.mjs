// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the viewer that need no browser.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { frame_plots } from '../viewer/frame_plots.mjs';
import { common_ball, Places } from '../viewer/places.mjs';

test('coordinates near the largest number are moved into the unit ball', () => {
  const object = { vertices: 2, box: [-1e308, 0, 0, 1.7e308, 1e308, 1e308], frames: [[0, 0, 0, 65535, 65535, 65535]] };
  const ball = common_ball([object]);
  assert.ok([...ball.centre, ball.radius].every(Number.isFinite));
  const places = new Places(object, ball);
  for (const vertex of [0, 1]) {
    const place = places.of_vertex(0, vertex);
    assert.ok(Math.abs(Math.hypot(...place) - 1) < 1e-6, String(place));
  }
});

test('coordinates at the ends of the numbers are drawn', () => {
  const m = Number.MAX_VALUE;
  const object = { vertices: 2, box: [-m, -m, -m, m, m, m], frames: [[0, 0, 0, 65535, 65535, 65535]] };
  const places = new Places(object, common_ball([object]));
  for (const vertex of [0, 1]) {
    const place = places.of_vertex(0, vertex);
    assert.ok(place.every((x) => Math.abs(Math.abs(x) - 1) < 0.5), String(place));
  }
});

test('frames are labelled by whole numbers, also where there are few', () => {
  const stage = (nearest) => ({ microseconds: { refit: 1 }, positive: nearest === 0, found: nearest === 0, near: null, nearest });
  const page = { header: { frames: 3, mode: 'exact' }, stages: [0, 1, 2].map(stage) };
  const plots = frame_plots(page, (frame) => frame);
  assert.deepEqual(plots.map(({ name }) => name), ['time', 'distance']);
  for (const { spec } of plots) assert.equal(spec.encoding.x.axis.tickMinStep, 1);
});

test('surfaces that always meet have a distance of 0 on the axis, not in its middle', () => {
  const stage = { microseconds: { refit: 1 }, positive: true, found: true, near: null, nearest: 0 };
  const distance = frame_plots({ header: { frames: 2, mode: 'exact' }, stages: [stage, stage] }, (frame) => frame).find(({ name }) => name === 'distance');
  assert.deepEqual(distance.spec.encoding.y.scale, { domainMin: 0, domainMax: 1 });
});
