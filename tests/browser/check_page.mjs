// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the page of scripts/build_browser in a headless browser against the program: check_page PAGE PROGRAM FOLDER.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { start_browser } from '../../web/src/browser.mjs';

const [page_file, program, folder] = process.argv.slice(2).map((word) => path.resolve(word));
fs.mkdirSync(folder, { recursive: true });
const in_folder = (name) => path.join(folder, name);
const make = (shape, name) => execFileSync(program, ['convert', `shape:${shape}`, in_folder(name), '--quiet']);
make('teapot', 'teapot.obj');
make('{"icosphere": {"frequency": 12}}', 'ball.stl');
make('{"icosphere": {"frequency": 160}}', 'large.stl');
fs.writeFileSync(in_folder('far.ply'), `ply
format ascii 1.0
element vertex 4
property double x
property double y
property double z
element face 4
property list uchar int vertex_indices
end_header
9 9 9
10 9 9
9 10 9
9 9 10
3 0 2 1
3 0 1 3
3 1 2 3
3 2 0 3
`);
fs.writeFileSync(in_folder('broken.off'), 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n');
// Tiny or huge coordinates: exact numbers decide.
const triangles = (scale) => `OFF\n6 2 0\n0 0 0\n${4 * scale} 0 0\n0 ${4 * scale} 0\n${scale} ${scale} ${-scale}\n${scale} ${scale} ${scale}\n${scale} ${-3 * scale} 0\n3 0 1 2\n3 3 4 5\n`;
fs.writeFileSync(in_folder('tiny.off'), triangles(2 ** -1000));
fs.writeFileSync(in_folder('huge.off'), triangles(2 ** 1000));

/** What the program says: the number of face pairs. */
function pairs_by_program(names) {
  const out = in_folder('out');
  const self = names.length === 1 ? ['--self'] : [];
  execFileSync(program, ['detect', ...names.map(in_folder), '--contacts', 'all', ...self, '--out', out, '--quiet']);
  const { pairs } = JSON.parse(fs.readFileSync(path.join(out, 'frames.jsonl'), 'utf8'));
  return pairs.reduce((sum, { faces }) => sum + faces.length, 0);
}

const browser = await start_browser();
try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  const problems = [];
  page.on('pageerror', (error) => problems.push(error.message));
  await page.goto(`file://${page_file}`);
  /** @param {...string[]} drops  files that are dropped together; later ones while the page checks those before */
  const ask = async (...drops) => {
    if (await page.isVisible('#clear')) await page.click('#clear');
    for (const names of drops) await page.setInputFiles('#files', names.map(in_folder));
    await page.waitForFunction(() => !['', 'Checking …'].includes(document.getElementById('answer').textContent), null, { timeout: 60_000 });
    return page.textContent('#answer');
  };
  for (const names of [['teapot.obj', 'ball.stl'], ['teapot.obj', 'far.ply'], ['teapot.obj'], ['ball.stl'], ['tiny.off'], ['huge.off']]) {
    const expected = pairs_by_program(names);
    const answer = await ask(names);
    console.log(`${names.join(', ')}: ${answer}`);
    if (expected > 0) assert.match(answer, new RegExp(`intersects?( itself)?: ${expected} face pairs?,`));
    else assert.match(answer, /(do|does) not intersect/);
    // The page below can be read, whatever the coordinates.
    await page.frameLocator('#viewer').locator('html[data-ready=yes]').waitFor({ timeout: 30_000 });
  }
  const both = pairs_by_program(['large.stl', 'teapot.obj']);
  assert.match(await ask(['large.stl'], ['teapot.obj']), new RegExp(`^They intersect: ${both} face pairs,`));
  assert.equal(await ask(['teapot.obj', 'broken.off']), 'broken.off:6: face refers to vertex 7 of 3 (counted from 0)');
  assert.ok(!(await page.isVisible('#viewer')), 'the meshes before an error are not shown below it');
  await ask(['teapot.obj', 'ball.stl']);
  const viewer = page.frameLocator('#viewer');
  await viewer.locator('#title').filter({ hasText: 'teapot.obj and ball.stl' }).waitFor({ timeout: 30_000 });
  assert.ok(!(await viewer.locator('#numbers').isVisible()), 'the page has no numbers');
  await page.waitForTimeout(1500);
  await page.screenshot({ path: in_folder('page.png') });
  await page.setViewportSize({ width: 390, height: 844 });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false, 'the page is too wide for a phone');
  await page.screenshot({ path: in_folder('phone.png') });
  await viewer.locator('body').evaluate((body, text) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], 'dropped.off'));
    body.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
  }, fs.readFileSync(in_folder('tiny.off'), 'utf8'));
  await page.waitForFunction(() => document.getElementById('answer').textContent.startsWith('It intersects itself'));
  await viewer.locator('#title').filter({ hasText: 'dropped.off' }).waitFor({ timeout: 30_000 });
  assert.deepEqual(problems, []);
} finally {
  await browser.close();
}
