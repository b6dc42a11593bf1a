// SPDX-License-Identifier: GPL-3.0-or-later
// What a page of the viewer shows, and what it says of damage.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { start_browser } from '../src/browser.mjs';
import { crowd_pairs, long_names, particles_note } from './make_page.mjs';
import {
  browser, busy_frame, changed_pixels, changes_picture, container, folder, frame_of, goto_frame, keep_picture, laptop, open, open_kind, phone,
  template, use_browser, write,
} from './viewer_pages.mjs';

describe('the viewer', () => {
  use_browser();

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
