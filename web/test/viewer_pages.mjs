// SPDX-License-Identifier: GPL-3.0-or-later
// Opens pages of the viewer in a browser, for tests. Timeouts are long, since the machine may be busy.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { after, afterEach, before } from 'node:test';
import { pathToFileURL } from 'node:url';
import { start_browser } from '../src/browser.mjs';
import { viewer_template } from '../src/viewer_template.mjs';
import { make_container } from './make_page.mjs';
import { fill } from './write_container.mjs';

export const laptop = { viewport: { width: 1280, height: 800 } };
export const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const patience = 60000;

export const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'viewer-'));
/** Of the tests that run. */
export let template, browser;

const made = new Map();
/** The container of a kind, and its contents. */
export function container(kind) {
  if (!made.has(kind)) made.set(kind, make_container(kind));
  return made.get(kind);
}

/** Writes a page with these data; returns its address. */
export function write(name, data) {
  const file = path.join(folder, `${name}.html`);
  fs.writeFileSync(file, fill(template, 'From the <template>', data));
  return pathToFileURL(file).href;
}

/** Opens a page, and records its logged errors and its requests. */
export async function open(url, options = laptop, where = browser) {
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

export const open_kind = (kind, options) => open(write(kind, container(kind).bytes), options);

export const frame_of = (page) => page.evaluate('lodestone.frame()');
export const settled = (page) => page.waitForFunction('lodestone.stats.settled');

export async function goto_frame(page, frame) {
  await page.evaluate((n) => window.lodestone.goto(n), frame);
  await settled(page);
}

/** Stores the picture in the page, once drawing has finished. */
export async function keep_picture(page) {
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
export async function changed_pixels(page) {
  await keep_picture(page);
  return page.evaluate(() => {
    const [a, b] = window.pictures;
    const differs = (i) => Math.max(Math.abs(a[i] - b[i]), Math.abs(a[i + 1] - b[i + 1]), Math.abs(a[i + 2] - b[i + 2])) > 24;
    let count = 0;
    for (let i = 0; i < a.length; i += 4) if (differs(i)) ++count;
    return count;
  });
}

export async function changes_picture(page, act, what) {
  await keep_picture(page);
  await act();
  const count = await changed_pixels(page);
  assert.ok(count > 150, `${what}: ${count} pixels`);
}

/** A frame in which everything is visible. */
export const busy_frame = (log) => log.findIndex(({ candidates, contacts }, f) => f > 10 && candidates.length > 0 && contacts.length > 0);

/** Starts the browser for the tests of a suite, and ends it after them. */
export function use_browser() {
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
}
