// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer in a browser. Timeouts are long, since the machine may be busy.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, afterEach, before, describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { start_browser } from '../src/browser.mjs';
import { viewer_template } from '../src/viewer_template.mjs';
import { crowd_pairs, long_names, make_container, particles_note } from './make_page.mjs';
import { fill } from './write_container.mjs';

const laptop = { viewport: { width: 1280, height: 800 } };
const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const patience = 60000;

const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'viewer-'));
let template, browser;

const made = new Map();
/** The container of a kind, and its contents. */
function container(kind) {
  if (!made.has(kind)) made.set(kind, make_container(kind));
  return made.get(kind);
}

/** Writes a page with these data; returns its address. */
function write(name, data) {
  const file = path.join(folder, `${name}.html`);
  fs.writeFileSync(file, fill(template, 'From the <template>', data));
  return pathToFileURL(file).href;
}

/** Opens a page, and records its logged errors and its requests. */
async function open(url, options = laptop, where = browser) {
  const page = await where.newPage(options);
  page.setDefaultTimeout(patience);
  const heard = { errors: [], requests: [] };
  page.on('console', (message) => message.type() === 'error' && heard.errors.push(message.text()));
  page.on('pageerror', (error) => heard.errors.push(error.message));
  page.on('request', (request) => request.url().startsWith('data:') || heard.requests.push(request.url()));
  await page.goto(url);
  await page.waitForSelector('html[data-ready]');
  return Object.assign(page, { heard });
}

const open_kind = (kind, options) => open(write(kind, container(kind).bytes), options);

const frame_of = (page) => page.evaluate('lodestone.frame()');
const settled = (page) => page.waitForFunction('lodestone.stats.settled');

async function goto_frame(page, frame) {
  await page.evaluate((n) => window.lodestone.goto(n), frame);
  await settled(page);
}

/** Stores the picture in the page, once drawing has finished. */
async function keep_picture(page) {
  await settled(page);
  await page.evaluate(() => {
    window.lodestone.view.draw();
    const gl = document.getElementById('canvas').getContext('webgl2');
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    window.pictures = [...(window.pictures ?? []).slice(-1), pixels];
  });
}

/** How many pixels changed visibly between the last two pictures. */
async function changed_pixels(page) {
  await keep_picture(page);
  return page.evaluate(() => {
    const [a, b] = window.pictures;
    const differs = (i) => Math.max(Math.abs(a[i] - b[i]), Math.abs(a[i + 1] - b[i + 1]), Math.abs(a[i + 2] - b[i + 2])) > 24;
    let count = 0;
    for (let i = 0; i < a.length; i += 4) if (differs(i)) ++count;
    return count;
  });
}

async function changes_picture(page, act, what) {
  await keep_picture(page);
  await act();
  const count = await changed_pixels(page);
  assert.ok(count > 150, `${what}: ${count} pixels`);
}

/** A frame in which everything is visible. */
const busy_frame = (log) => log.findIndex(({ candidates, contacts }, f) => f > 10 && candidates.length > 0 && contacts.length > 0);

describe('the viewer', () => {
  before(async () => {
    template = await viewer_template();
    browser = await start_browser();
  });
  afterEach(async () => {
    for (const context of browser.contexts()) await context.close();
  });
  after(async () => {
    await browser?.close();
    fs.rmSync(folder, { recursive: true });
  });

  test('the template has each placeholder once, and a page opens silently and from one file', async () => {
    for (const placeholder of ['@LODESTONE_TITLE@', '@LODESTONE_DATA@']) assert.equal(template.split(placeholder).length, 2);
    const url = write('run', container('run').bytes);
    const page = await open(url);
    await page.evaluate('lodestone.plots_ready');
    assert.deepEqual(page.heard, { errors: [], requests: [url] });
    assert.equal(await page.title(), 'From the <template>');
    assert.equal(await page.textContent('#title'), 'Example & test: run');
    assert.equal(await page.evaluate('lodestone.frames'), 300);
  });

  test('the figures are those of frames.jsonl, and time is shown per stage', async () => {
    const { lines, log } = container('small');
    const page = await open_kind('small');
    for (const frame of [0, 17, busy_frame(log), 39]) {
      await page.evaluate((n) => window.lodestone.goto(n), frame);
      const line = JSON.parse(lines[frame]);
      assert.deepEqual(await page.evaluate('lodestone.numbers()'), line);
      for (const name of ['iterations', 'moves', 'candidates', 'exact_tests', 'contacts'])
        assert.equal(await page.textContent(`#number-${name}`), String(line.statistics[name]), name);
      assert.equal(await page.textContent('#number-colliding_pairs'), log[frame].found ? '1' : '0');
      assert.match(await page.textContent('#stage-relaxation'), /^\d+(\.\d+)? µs$/);
      const outcome = !log[frame].positive ? 'No collision' : log[frame].found ? 'Collision, confirmed' : 'Collision, missed';
      assert.equal(await page.textContent('#outcome'), outcome);
    }
    await page.waitForFunction(() => document.getElementById('spoken').textContent.startsWith('Frame 39'));
  });

  test('a mode that may miss collisions says so on the page', async () => {
    for (const options of [laptop, phone]) {
      const page = await open_kind('small', options);
      assert.ok(await page.isVisible('#note'));
      assert.equal(await page.textContent('#note'), particles_note);
    }
  });

  test('of a pair that was not found, only a mode that may miss collisions says that it may not be apart', async () => {
    for (const [kind, words] of [['small', 'apart or not found'], ['exact', 'apart']]) {
      const page = await open_kind(kind);
      await page.evaluate((n) => window.lodestone.goto(n), container(kind).log.findIndex(({ positive }) => !positive));
      assert.equal(await page.textContent('#pairs .state'), words);
    }
  });

  test('pairs of objects that have the same names are all listed, those found first', async () => {
    const { log } = container('crowd');
    const page = await open_kind('crowd');
    await page.evaluate((n) => window.lodestone.goto(n), busy_frame(log));
    assert.deepEqual(await page.locator('#pairs .name').allTextContents(), new Array(crowd_pairs).fill('body – body'));
    const states = await page.locator('#pairs .state').allTextContents();
    assert.equal(await page.textContent('#pair-count'), `${crowd_pairs} pairs of objects; scroll for more`);
    const fades = (expected) => page.waitForFunction((is) => document.getElementById('pairs').matches('.more') === is, expected);
    await fades(true);
    await page.focus('#pairs');
    await page.keyboard.press('PageDown');
    await page.waitForFunction(() => document.getElementById('pairs').scrollTop > 0);
    await page.evaluate(() => (document.getElementById('pairs').scrollTop = 1e6));
    await fades(false);
    assert.ok(!(await (await open_kind('small')).isVisible('#pair-count')));
    assert.deepEqual(states.map((state) => /^collide, \d+ face pairs$/.test(state)), states.map((_, i) => i < crowd_pairs / 5));
  });

  test('every layer and every object can be hidden and changed, by click and by hook', async () => {
    const { log } = container('small');
    const page = await open_kind('small');
    await goto_frame(page, busy_frame(log));
    const keys = await page.evaluate('Object.keys(lodestone.layers)');
    assert.deepEqual(keys, ['surfaces', 'regions', 'wireframe', 'particles', 'trails', 'candidates', 'segments', 'faces', 'near']);
    for (const key of keys) {
      // The inside is visible through the knot, and candidate pairs are shown only by their lines.
      if (key === 'candidates') {
        await changes_picture(page, () => page.check('#object-0-translucent'), 'translucent');
        await page.evaluate(() => (window.lodestone.layers.regions = window.lodestone.layers.particles = false));
      }
      if (key === 'near') continue;  // This page has no such faces.
      const on = await page.isChecked(`#layer-${key}`);
      await changes_picture(page, () => page.setChecked(`#layer-${key}`, !on), key);
      assert.equal(await page.evaluate((name) => window.lodestone.layers[name], key), !on);
      await page.evaluate(([name, value]) => (window.lodestone.layers[name] = value), [key, on]);
      assert.equal(await page.isChecked(`#layer-${key}`), on);
    }
    await changes_picture(page, () => page.uncheck('#object-1-visible'), 'visible');
    assert.ok(await page.isDisabled('#object-1-translucent'));
  });

  test('candidate pairs are hidden at first where a frame has very many of them', async () => {
    for (const [kind, many] of [['small', false], ['crowd', true]]) {
      assert.equal(container(kind).log.some(({ candidates }) => candidates.length > 60), many);
      const page = await open_kind(kind);
      assert.equal(await page.isChecked('#layer-candidates'), !many);
      if (!many) continue;
      await goto_frame(page, busy_frame(container(kind).log));
      await changes_picture(page, () => page.check('#layer-candidates'), 'candidates');
    }
  });

  test('faces that are only near have a layer of their own, and frames without collision say so', async () => {
    const { lines, log } = container('near');
    const page = await open_kind('near');
    const only_near = log.findIndex(({ positive, near }) => near && !positive);
    await goto_frame(page, only_near);
    assert.equal(await page.textContent('#outcome'), 'Near, no collision');
    assert.equal(await page.textContent('#pairs .state'), `near, ${log[only_near].contacts.length} face pairs`);
    assert.match(await page.getAttribute('#timeline', 'aria-valuetext'), /, near, no collision$/);
    await changes_picture(page, () => page.uncheck('#layer-near'), 'near faces');
    await page.check('#layer-near');
    await keep_picture(page);
    await page.uncheck('#layer-faces');
    await page.uncheck('#layer-segments');
    assert.equal(await changed_pixels(page), 0, 'nothing intersects in this frame');

    const colliding = log.findIndex(({ positive, contacts }) => positive && contacts.some(({ length }) => length > 10));
    const { intersects } = JSON.parse(lines[colliding]).pairs[0];
    const crossing = intersects.filter(Boolean).length;
    await goto_frame(page, colliding);
    assert.equal(await page.textContent('#pairs .state'), `collide, ${crossing} face pairs, ${intersects.length - crossing} near`);
    for (const layer of ['faces', 'segments', 'near']) {
      const on = await page.isChecked(`#layer-${layer}`);
      await changes_picture(page, () => page.setChecked(`#layer-${layer}`, !on), layer);
    }
    await page.click('.legend.near');
    assert.equal(await frame_of(page), log.findIndex(({ positive, near }, f) => f > colliding && near && !positive));
    assert.match(await page.textContent('.legend.near'), new RegExp(`^${log.filter(({ positive, near }) => near && !positive).length} only near`));
    assert.ok((await page.locator('.detail rect.near').count()) > 0);
    assert.deepEqual(await page.locator('.lane-names.of-detail span').allTextContents(), ['colliding', 'confirmed', 'missed', 'only near']);
    assert.equal(await (await open_kind('small')).locator('.legend.near').count(), 0);
  });

  test('each key does what the list says', async () => {
    const page = await open_kind('small');
    const press = (key) => page.keyboard.press(key);
    const lands_on = async (key, frame) => (await press(key), assert.equal(await frame_of(page), frame, key));
    await lands_on('ArrowRight', 1);
    await lands_on('Shift+ArrowRight', 11);
    await lands_on('ArrowLeft', 10);
    await lands_on('End', 39);
    await lands_on('Shift+ArrowLeft', 29);
    await lands_on('Home', 0);
    const speed = () => page.inputValue('#speed');
    await press('+');
    assert.equal(await speed(), '2');
    await press('-');
    await press('-');
    assert.equal(await speed(), '0.5');
    await press('l');
    assert.equal(await page.getAttribute('#loop', 'aria-pressed'), 'false');
    for (const [i, key] of (await page.evaluate('Object.keys(lodestone.layers)')).entries()) {
      if (key === 'near') continue;  // This page has no such faces.
      const on = await page.isChecked(`#layer-${key}`);
      await press(String(i + 1));
      assert.equal(await page.isChecked(`#layer-${key}`), !on, key);
      await press(String(i + 1));
    }
    for (const key of ['a', 'w', 'e']) await changes_picture(page, () => press(key), key);
    await press('r');
    await keep_picture(page);
    for (const key of ['d', 's', 'q', 'r']) await press(key);
    assert.equal(await changed_pixels(page), 0, 'r');
    await press('?');
    assert.ok(await page.isVisible('#help'));
    await press('ArrowRight');
    assert.equal(await frame_of(page), 0);
    await press('Escape');
    assert.ok(!(await page.isVisible('#help')));
    await press('Space');
    await page.waitForFunction('lodestone.frame() > 0');
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Pause');
    await press('Space');
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
  });

  test('a key that is held plays once, and steps on; capital letters are letters', async () => {
    const page = await open_kind('small');
    const held = async (key) => {
      for (let i = 0; i < 4; ++i) await page.keyboard.down(key);  // From the second on they are repetitions.
      await page.keyboard.up(key);
    };
    await held('ArrowRight');
    assert.equal(await frame_of(page), 4);
    await held('k');
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Pause');
    await page.keyboard.press('K');
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
    await changes_picture(page, () => held('A'), 'A');
  });

  test('the timeline takes the keys of a slider while it has the focus', async () => {
    const page = await open_kind('small');
    await page.focus('#timeline');
    for (const [key, frame] of [['ArrowUp', 1], ['PageUp', 11], ['ArrowDown', 10], ['PageDown', 0], ['ArrowDown', 0], ['ArrowRight', 1], ['End', 39], ['PageUp', 39]]) {
      await page.keyboard.press(key);
      assert.equal(await frame_of(page), frame, key);
    }
  });

  test('a page that shows some frames of a run, with one contact of each pair, says so', async () => {
    const page = await open_kind('sampled');
    assert.match(await page.textContent('#subtitle'), / · 40 frames shown, one of every 10$/);
    const { log } = container('sampled');
    await page.evaluate((n) => window.lodestone.player.goto(n), log.findIndex(({ found }) => found));
    assert.equal(await page.locator('#pairs .state').first().textContent(), 'collide');
    await page.evaluate('lodestone.plots_ready');
    assert.match(await page.textContent('#plots'), /Of the frames shown with a collision up to here/);
    assert.ok(!/frames shown/.test(await (await open_kind('small')).textContent('#plots')));
  });

  test('the keys that are listed are those of the page', async () => {
    const listed = async (kind) => {
      const page = await open_kind(kind);
      const hint = await page.locator('#layer-keys').textContent();
      await page.keyboard.press('?');
      const [keys, names] = await Promise.all(['dt', 'dd'].map((tag) => page.locator(`#keys ${tag}`).allTextContents()));
      const row = names.findIndex((name) => name.startsWith('layers: '));
      return { hint, keys: keys[row], names: names[row], plays: names.includes('play or pause') };
    };
    assert.deepEqual(await listed('exact'), { hint: '138', keys: '138', names: 'layers: surfaces, wireframe, intersecting faces', plays: true });
    const partition = await listed('partition');
    assert.deepEqual([partition.keys, partition.plays], ['1…4', false]);
  });

  test('it plays to the end and stops there, or goes on in a loop; the camera turns by mouse', async () => {
    const page = await open_kind('small');
    assert.equal(await page.evaluate('lodestone.player.playing'), false);
    await page.click('#loop');
    await page.selectOption('#speed', '4');
    await page.click('#play');
    await page.waitForFunction('!lodestone.player.playing');
    assert.equal(await frame_of(page), 39);
    await page.click('#loop');
    await page.click('#play');
    await page.waitForFunction('lodestone.player.playing && lodestone.frame() > 20');
    await page.waitForFunction('lodestone.frame() < 20');
    await page.click('#play');
    await changes_picture(page, async () => {
      await page.mouse.move(400, 300);
      await page.mouse.down();
      await page.mouse.move(500, 340, { steps: 3 });
      await page.mouse.up();
    }, 'dragging');
    await changes_picture(page, () => page.click('#reset'), 'reset');
  });

  test('frames are chosen on the timeline, its legend and the plots', async () => {
    const { log } = container('small');
    const page = await open_kind('small');
    const bar = await page.locator('.detail').boundingBox();
    const at = (frame) => bar.x + ((frame + 0.5) / 40) * bar.width;
    await page.mouse.move(at(10), bar.y + 10);
    await page.mouse.down();
    assert.equal(await frame_of(page), 10);
    await page.mouse.move(at(31), bar.y + 10, { steps: 4 });
    assert.equal(await frame_of(page), 31);
    await page.mouse.up();
    await page.mouse.move(at(5), bar.y + 10);
    assert.equal(await frame_of(page), 31);
    assert.match(await page.getAttribute('#timeline', 'aria-valuetext'), /^frame 31, /);
    await page.mouse.wheel(0, -600);
    await page.waitForFunction(() => Number(document.querySelector('.detail svg').getAttribute('viewBox').split(' ')[2]) < 20);
    await page.click('#zoom button:last-child');
    await page.evaluate('lodestone.goto(0)');
    await page.click('.legend.missed');
    assert.equal(await frame_of(page), log.findIndex(({ positive, found }) => positive && !found));
    assert.match(await page.textContent('.legend.missed'), new RegExp(`^${log.filter(({ positive, found }) => positive && !found).length} missed`));
    await page.evaluate('lodestone.plots_ready');
    for (const name of ['time', 'distance', 'recall']) {
      const plot = page.locator(`#plot-${name}`);
      await plot.scrollIntoViewIfNeeded();
      const box = await plot.boundingBox();
      const rule = page.locator('.plot-frame', { has: plot }).locator('.rule');
      for (const part of [0.7, 0.4]) {
        await page.mouse.click(box.x + part * box.width, box.y + 60);
        // The rule moves to the position of the click, within half a frame.
        const { x } = await rule.boundingBox();
        assert.ok(Math.abs(x - (box.x + part * box.width)) < (0.6 * box.width) / 39, `${name}: ${x}`);
      }
    }
  });

  test('dragging to the edge of a part of the timeline does not move that part', async () => {
    const page = await open_kind('small');
    await page.evaluate('lodestone.goto(20)');
    const part = () => page.evaluate(() => document.querySelector('.detail svg').getAttribute('viewBox'));
    const bar = await page.locator('.detail').boundingBox();
    await page.mouse.move(bar.x + 0.43 * bar.width, bar.y + 10);
    await page.mouse.wheel(0, -300);
    await page.waitForFunction(() => Number(document.querySelector('.detail svg').getAttribute('viewBox').split(' ')[2]) < 39);
    const before = await part();
    assert.match(before, /^\d+\.\d/, 'a part that begins with a whole frame would test nothing');
    await page.mouse.down();
    for (const side of [0, 1])
      for (let i = 0; i < 6; ++i) await page.mouse.move(bar.x + side * bar.width + i, bar.y + 10);
    assert.equal(await part(), before);
    await page.mouse.up();
  });

  test('on a phone nothing scrolls sideways, and fingers move and zoom the timeline', async () => {
    const page = await open_kind('small', phone);
    await page.evaluate('lodestone.plots_ready');
    assert.ok((await page.evaluate('document.documentElement.scrollWidth')) <= 390);
    const bar = await page.locator('.detail').boundingBox();
    assert.ok(bar.y + bar.height < 844);
    await page.touchscreen.tap(bar.x + bar.width * 0.5, bar.y + 10);
    assert.equal(await frame_of(page), 20);
    const touch = await page.context().newCDPSession(page);
    const place = (x, id) => ({ x: bar.x + x * bar.width, y: bar.y + 10, id });
    const fingers = (type, ...places) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: places.map(place) });
    await fingers('touchStart', 0.45);
    await fingers('touchStart', 0.45, 0.55);
    for (const spread of [0.1, 0.15, 0.2]) await fingers('touchMove', 0.5 - spread, 0.5 + spread);
    await fingers('touchEnd');
    await page.waitForFunction(() => Number(document.querySelector('.detail svg').getAttribute('viewBox').split(' ')[2]) < 15);
  });

  test('light and dark differ, by the system and by the button', async () => {
    const url = write('small', container('small').bytes);
    const background = (page) => page.evaluate('getComputedStyle(document.body).backgroundColor');
    const light = await open(url, { ...laptop, colorScheme: 'light' });
    const dark = await open(url, { ...laptop, colorScheme: 'dark' });
    assert.notEqual(await background(light), await background(dark));
    // Nothing but the background is in the corner of the picture.
    const corner = (page) => keep_picture(page).then(() => page.evaluate('window.pictures.at(-1)[0]'));
    assert.ok((await corner(light)) > 200 && (await corner(dark)) < 50);
    await light.click('#theme');
    assert.equal(await background(light), await background(dark));
    assert.ok((await corner(light)) < 50);
  });

  test('a partition stands still, mode exact has no regions, and an experiment is a report with plots', async () => {
    const still = await open_kind('partition');
    assert.ok(!(await still.isVisible('#time')) && (await still.isVisible('#canvas')));
    const layers_of = (page) => page.locator('#layers input').evaluateAll((boxes) => boxes.map(({ id }) => id.replace('layer-', '')));
    assert.deepEqual(await layers_of(still), ['surfaces', 'regions', 'wireframe', 'particles']);
    assert.match(await still.textContent('#objects'), /32 regions/);
    assert.equal(await still.textContent('#numbers-title'), 'This partition');
    assert.equal(await still.textContent('#number-size_balance'), '1.5');
    assert.ok(!(await still.isVisible('#pairs')));
    const exact = await open_kind('exact');
    assert.ok(!(await exact.isVisible('#note')));
    assert.equal(await exact.textContent('#numbers-title'), 'This frame');
    assert.deepEqual(await layers_of(exact), ['surfaces', 'wireframe', 'faces']);
    assert.ok(await exact.isVisible('#number-leaf_tests'));
    await exact.evaluate('lodestone.plots_ready');
    assert.deepEqual(await exact.locator('#frame-plots .plot').evaluateAll((plots) => plots.map(({ id }) => id)), ['plot-time', 'plot-distance']);
    const report = await open_kind('experiment');
    await report.evaluate('lodestone.plots_ready');
    assert.ok(!(await report.isVisible('#viewer')));
    assert.equal(await report.textContent('#report h2'), 'Does it walk?');
    assert.match(await report.textContent('#report p'), /<script>alert\(1\)<\/script> stays text/);
    assert.deepEqual(await report.locator('#report th').allTextContents(), ['mesh', 'particles', 'recall', 'a | b']);
    assert.equal(await report.locator('#report td').nth(1).evaluate((cell) => cell.style.textAlign), 'right');
    assert.equal(await report.locator('#report li').nth(1).textContent(), 'two, which goes on in the next line');
    assert.equal(await report.textContent('#report pre'), 'lodestone experiment walks | head');
    assert.equal(await report.locator('#plot-sweep [aria-roledescription=point]').count(), 4);
    for (const page of [still, exact, report]) assert.deepEqual(page.heard.errors, []);
  });

  test('without results there is a timeline too, and mode exact does not say twice what collides', async () => {
    const lanes = (page) => page.locator('.lane-names.of-detail span').allTextContents();
    const bare = await open_kind('bare');
    assert.deepEqual(await lanes(bare), ['frames']);
    for (const track of ['.overview', '.detail']) assert.ok((await bare.locator(`${track} svg rect`).boundingBox()).height > 8);
    assert.deepEqual(bare.heard.errors, []);
    const exact = await open_kind('exact');
    assert.deepEqual(await lanes(exact), ['colliding']);
    const { log } = container('exact');
    assert.equal(await exact.textContent('.legend'), `${log.filter(({ found }) => found).length} colliding`);
  });

  test('a click keeps the camera, which then still follows the size of the window; wheel and keys come very near', async () => {
    const page = await open_kind('small');
    const distance = () => page.evaluate('lodestone.view.controls.getDistance()');
    const first = await distance();
    const resized = async (width) => {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForFunction((w) => document.getElementById('canvas').clientWidth < w, width);
      await settled(page);
    };
    await page.mouse.click(400, 300);
    assert.equal(await distance(), first);
    await resized(900);
    assert.notEqual(await distance(), first);
    await page.mouse.move(400, 300);
    for (let i = 0; i < 60; ++i) await page.mouse.wheel(0, -400);
    await page.waitForFunction('lodestone.view.controls.getDistance() < 0.01');
    await settled(page);
    assert.ok((await page.evaluate('lodestone.view.camera.near')) < 0.001);
    const near = await distance();
    await resized(1000);
    assert.equal(await distance(), near);
    assert.deepEqual(page.heard.errors, []);
  });

  test('the wheel reaches what is under the pointer, wherever the middle is; from nearby every move is drawn', async () => {
    const page = await open_kind('small');
    const far_from_middle = await page.evaluate(() => {
      const { view } = window.lodestone;
      for (let y = 120; y < 560; y += 10)
        for (let x = 100; x < 800; x += 10) {
          const { distance } = view.look_at(x, y);
          if (distance < Infinity && Math.abs(distance - view.controls.getDistance()) > 0.25) return [x, y];
        }
    });
    const distance = () => page.evaluate(([x, y]) => window.lodestone.view.look_at(x, y).distance, far_from_middle);
    assert.ok((await distance()) > 1);
    await page.mouse.move(...far_from_middle);
    for (let i = 0; i < 60; ++i) await page.mouse.wheel(0, -400);
    await page.waitForFunction('lodestone.view.controls.getDistance() < 0.003');
    assert.ok((await distance()) < 0.01);
    await settled(page);
    const draws = () => page.evaluate('lodestone.stats.draws');
    const before = await draws();
    await page.mouse.down({ button: 'right' });
    for (let i = 1; i <= 8; ++i) {
      await page.mouse.move(far_from_middle[0] + 5 * i, far_from_middle[1]);
      await page.waitForFunction((count) => window.lodestone.stats.draws >= count, before + i);
    }
    await page.mouse.up({ button: 'right' });
    for (let i = 0; i < 60; ++i) await page.mouse.wheel(0, 800);
    await page.waitForFunction('lodestone.view.controls.getDistance() > 15');
    assert.ok((await page.evaluate('lodestone.view.controls.target.length()')) <= 2);
  });

  test('names of any length and script stand beside what is said of them', async () => {
    const page = await open_kind('names');
    const [name, state] = await Promise.all(['.name', '.state'].map((part) => page.locator(`#pairs ${part}`).first().boundingBox()));
    const panel = await page.locator('#panel').boundingBox();
    assert.ok(name.x + name.width <= state.x && state.x + state.width <= panel.x + panel.width);
    assert.equal(await page.locator('#pairs .name').first().textContent(), long_names.join(' – '));
    const ends = await page.locator('#pairs bdi').evaluateAll((names) => names.slice(0, 2).map((part) => part.getBoundingClientRect().top));
    assert.ok(ends[0] < ends[1], 'the first name stands first');
    assert.ok(await page.isVisible('#help-button') && (await page.locator('#help-button').boundingBox()).x < 1280);
    assert.ok((await page.evaluate('document.documentElement.scrollWidth')) <= 1280);
  });

  test('a page that is cut off in its data, or may not run scripts, says so', async () => {
    const url = write('small', container('small').bytes);
    const whole = fs.readFileSync(new URL(url), 'utf8');
    const cut = path.join(folder, 'cut.html');
    fs.writeFileSync(cut, whole.slice(0, whole.indexOf('id="lodestone-data"') + 5000));
    const page = await browser.newPage(laptop);
    await page.goto(pathToFileURL(cut).href);
    assert.ok(!(await page.isVisible('#waiting')), 'not at once, since most pages open soon');
    await page.waitForFunction(() => getComputedStyle(document.getElementById('waiting')).visibility === 'visible');
    assert.match(await page.textContent('#waiting'), /cut off/);
    assert.ok(!(await page.isVisible('noscript')));
    const silent = await (await browser.newContext({ ...laptop, javaScriptEnabled: false })).newPage();
    await silent.goto(url);
    assert.match(await silent.locator('noscript').innerText(), /scripts are off/);
    assert.equal(await (await open(url)).locator('#waiting').count(), 0);
  });

  test('a browser that cannot unpack the data is told from damaged data', async () => {
    const page = await browser.newPage(laptop);
    await page.addInitScript(() => delete window.DecompressionStream);
    await page.goto(write('small', container('small').bytes));
    await page.waitForSelector('html[data-ready=no]');
    assert.match(await page.textContent('#problem-text'), /^This browser cannot unpack the data/);
    assert.equal(await page.textContent('#problem-advice'), 'Open the page in a newer browser.');
    assert.equal(await page.locator('#waiting').count(), 0);
  });

  test('damaged data, another version and the bare template are told apart in words', async () => {
    const { bytes } = container('partition');
    const broken = (change) => {
      const copy = Buffer.from(bytes);
      change(copy);
      return copy;
    };
    const cases = {
      cut: [bytes.subarray(0, bytes.length - 200), /ends early/],
      header: [bytes.subarray(0, 40), /ends early/],
      overwritten: [broken((copy) => copy.fill(255, copy.length - 400)), /^(Labels|Particles|Positions|Topology) \d.*: /],
      version: [broken((copy) => void copy.writeUInt32LE(2, 8)), /version 2, and this viewer reads version 1/],
      other: [Buffer.from('something else altogether'), /not one of Lodestone/],
      text: ['not / base64 !', /not base64/],
      bare: ['@' + 'LODESTONE_DATA@', /template/],
    };
    for (const [name, [data, message]] of Object.entries(cases)) {
      const page = await open(write(name, data));
      assert.match(await page.textContent('#problem-text'), message, name);
      assert.ok((await page.isVisible('#problem')) && !(await page.isVisible('#viewer')), name);
      assert.deepEqual(page.heard.errors, [], name);
      assert.ok(await page.evaluate('lodestone.ready.then(() => false, () => true)'), name);
      await page.close();
    }
  });

  test('without WebGL a message stands for the picture, and the rest works', async (t) => {
    const plain = await start_browser(['--disable-gpu', '--disable-3d-apis']);
    t.after(() => plain.close());
    const { bytes, lines } = container('small');
    const page = await open(write('small', bytes), laptop, plain);
    assert.match(await page.textContent('#no-webgl'), /no WebGL 2/);
    assert.ok(await page.isVisible('#no-webgl'));
    await page.keyboard.press('End');
    assert.equal(await page.textContent('#number-moves'), String(JSON.parse(lines[39]).statistics.moves));
    await page.evaluate('lodestone.plots_ready');
    assert.ok((await page.locator('#plot-recall svg').count()) > 0);
    assert.deepEqual(page.heard.errors, []);
  });
});
