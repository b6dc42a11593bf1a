// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { start_browser } from '../src/browser.mjs';
import { plots_page } from '../src/plots_page.mjs';
import { read_plots } from '../src/plot_spec.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const screens = {
  laptop: { viewport: { width: 1280, height: 800 }, colorScheme: 'light' },
  dark: { viewport: { width: 1280, height: 800 }, colorScheme: 'dark' },
  phone: { viewport: { width: 360, height: 740 }, colorScheme: 'light' },
};

test('the page draws every plot from one file, fits the screen, and tells values', async (t) => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'page-'));
  t.after(() => fs.rmSync(folder, { recursive: true }));
  const file = path.join(folder, 'plots.html');
  fs.writeFileSync(file, await plots_page('Example', read_plots(path.join(here, 'plots'), path.join(here, 'data'))));
  const browser = await start_browser();
  t.after(() => browser.close());
  for (const [name, screen] of Object.entries(screens)) {
    const page = await browser.newPage(screen);
    const requests = [];
    const errors = [];
    page.on('request', (request) => requests.push(request.url()));
    page.on('pageerror', (error) => errors.push(error.message));
    await page.goto(pathToFileURL(file).href);
    await page.waitForSelector('html[data-drawn]');
    assert.deepEqual(errors, []);
    assert.deepEqual(requests.filter((url) => !url.startsWith('data:')), [pathToFileURL(file).href]);
    assert.equal(await page.locator('#plot-time [aria-roledescription=point]').count(), 48);
    assert.ok((await page.evaluate('document.documentElement.scrollWidth')) <= screen.viewport.width, name);
    await page.locator('#plot-time [aria-roledescription=point]').last().hover();
    await page.waitForSelector('#vg-tooltip-element.visible');
    assert.match(await page.textContent('#vg-tooltip-element'), /grid.*teapot/);
    await page.close();
  }
});

test('plots of the same data hold it once', async () => {
  const rows = Array.from({ length: 50 }, (_, i) => ({ marked: `row-${i}-`, x: i }));
  const spec = { data: { values: rows }, mark: 'point', encoding: { x: { field: 'x', type: 'quantitative' } } };
  const plots = ['a', 'b'].map((name) => ({ name, title: name, description: '', spec: structuredClone(spec) }));
  const html = await plots_page('Twice', plots);
  assert.equal(html.split('row-7-').length - 1, 1);
});

test('a plot may have any name, and one that fails leaves the others as they are', async (t) => {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'page-'));
  t.after(() => fs.rmSync(folder, { recursive: true }));
  const spec = { data: { values: [{ x: 1 }, { x: 2 }] }, mark: 'point', encoding: { x: { field: 'x', type: 'quantitative' } } };
  const plots = ['data', 'plots', 'broken'].map((name) => ({ name, title: name, description: '', spec: structuredClone(spec) }));
  plots[2].spec.transform = [{ calculate: 'this is no expression', as: 'y' }];
  const file = path.join(folder, 'plots.html');
  fs.writeFileSync(file, await plots_page('Names', plots));
  const browser = await start_browser();
  t.after(() => browser.close());
  const page = await browser.newPage(screens.laptop);
  const errors = [];
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('html[data-drawn]');
  for (const name of ['data', 'plots']) assert.equal(await page.locator(`#plot-${name} [aria-roledescription=point]`).count(), 2);
  assert.match(await page.textContent('#plot-broken'), /^This plot cannot be drawn: /);
  assert.deepEqual(errors, []);
});
