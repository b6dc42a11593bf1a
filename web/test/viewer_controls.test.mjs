// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer by keys, mouse and fingers.
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { changed_pixels, changes_picture, container, frame_of, keep_picture, open_kind, phone, settled, use_browser } from './viewer_pages.mjs';

describe('the controls of the viewer', () => {
  use_browser();

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
});
