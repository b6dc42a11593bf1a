// SPDX-License-Identifier: GPL-3.0-or-later
// A page that the program writes for the paper's pair shows the same results as the program's other files.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { start_browser } from '../src/browser.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const program = process.env.LODESTONE ?? path.join(root, 'build/release/lodestone');
const skip = fs.existsSync(program) ? false : `${program} is not built`;

async function open(t, folder, file) {
  const browser = await start_browser();
  t.after(() => browser.close());
  t.after(() => fs.rmSync(folder, { recursive: true }));
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const errors = [];
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(pathToFileURL(file).href);
  await page.evaluate('lodestone.ready');
  return { page, errors };
}

test('a run of 300 frames is a small page that shows the numbers of frames.jsonl', { skip }, async (t) => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'program-page-'));
  const file = path.join(folder, 'run.html');
  const scene = path.join(root, 'data/scenes/teapot_sphere_1.json');
  execFileSync(program, ['detect', scene, '--mode', 'particles', '--particles', '32', '--html', file, '--out', folder, '--quiet']);
  assert.ok(fs.statSync(file).size < 15e6);
  const lines = fs.readFileSync(path.join(folder, 'frames.jsonl'), 'utf8').trimEnd().split('\n').map((line) => JSON.parse(line));
  assert.equal(lines.length, 300);

  const { page, errors } = await open(t, folder, file);
  assert.equal(await page.evaluate('lodestone.frames'), 300);
  let colliding = 0;
  for (const frame of [0, 1, 47, 60, 112, 133, 180, 260, 299]) {
    await page.evaluate((n) => window.lodestone.goto(n), frame);
    assert.equal(await page.evaluate('lodestone.frame()'), frame);
    assert.deepEqual(await page.evaluate('lodestone.numbers()'), lines[frame]);
    colliding += lines[frame].pairs.some((pair) => pair.collides) ? 1 : 0;
    const shown = await page.textContent('body');
    assert.match(shown, new RegExp(`Exact tests\\s*${lines[frame].statistics.exact_tests}(?!\\d)`));
  }
  assert.ok(colliding > 2);
  assert.deepEqual(errors, []);
});

test('of many pairs of objects those that collide are listed first', { skip }, async (t) => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'program-page-'));
  const file = path.join(folder, 'run.html');
  const scene = path.join(root, 'data/scenes/bodies_20.json');
  execFileSync(program, ['detect', scene, '--html', file, '--out', folder, '--quiet']);
  const lines = fs.readFileSync(path.join(folder, 'frames.jsonl'), 'utf8').trimEnd().split('\n').map((line) => JSON.parse(line));
  const frame = lines.findIndex(({ pairs }) => pairs.length > 6 && pairs.some((pair, i) => pair.collides && i > 0 && !pairs[i - 1].collides));
  assert.ok(frame >= 0);
  const { page, errors } = await open(t, folder, file);
  await page.evaluate((n) => window.lodestone.goto(n), frame);
  const { pairs } = lines[frame];
  const names = [true, false].flatMap((collides) => pairs.filter((pair) => pair.collides === collides)).map(({ a, b }) => `${a} – ${b}`);
  assert.deepEqual(await page.locator('#pairs .name').allTextContents(), names);
  assert.deepEqual(errors, []);
});

test('a partition is a page with one frame and no timeline to play', { skip }, async (t) => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'program-page-'));
  const mesh = path.join(folder, 'mesh.off');
  fs.writeFileSync(mesh, 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n');
  const file = path.join(folder, 'partition.html');
  execFileSync(program, ['partition', mesh, '--regions', '3', '--html', file, '--quiet']);
  const { page, errors } = await open(t, folder, file);
  assert.equal(await page.evaluate('lodestone.frames'), 1);
  const numbers = await page.evaluate('lodestone.numbers()');
  assert.equal(numbers.regions, 3);
  assert.equal(await page.textContent('#number-regions'), '3');
  assert.equal(Number(await page.textContent('#number-size_balance')), numbers.measures.size_balance);
  assert.deepEqual(errors, []);
});
