// SPDX-License-Identifier: GPL-3.0-or-later
// Screenshots of a viewer page: PAGE.html OUT.png [--frame N] [--width W] [--height H] [--dark]
import path from 'node:path';
import { parseArgs } from 'node:util';
import { pathToFileURL } from 'node:url';
import { start_browser } from './src/browser.mjs';
import { Bad_input, read_file, run_command, write_whole } from './src/command.mjs';

const usage = 'usage: screenshots PAGE.html OUT.png [--frame N] [--width W] [--height H] [--dark]';

async function main(words) {
  const { page: file, out, frame, width, height, dark } = read_arguments(words);
  read_file(file);
  const browser = await start_browser();
  try {
    const page = await browser.newPage({ viewport: { width, height }, colorScheme: dark ? 'dark' : 'light' });
    await page.goto(pathToFileURL(path.resolve(file)).href);
    await page.evaluate('lodestone.ready');
    const frames = await page.evaluate('lodestone.frames');
    if (frame >= frames) throw new Bad_input(`${file}: has ${frames} frames, there is no frame ${frame}`);
    await page.evaluate((n) => window.lodestone.goto(n), frame);
    await page.evaluate('lodestone.plots_ready');
    await page.waitForFunction('lodestone.stats.settled');
    write_whole(out, await page.screenshot());
  } finally {
    await browser.close();
  }
}

function read_arguments(words) {
  const options = { frame: { type: 'string' }, width: { type: 'string' }, height: { type: 'string' }, dark: { type: 'boolean' } };
  try {
    const { values, positionals } = parseArgs({ args: words, allowPositionals: true, options });
    if (positionals.length !== 2) throw new Error(usage);
    const number = (name, otherwise) => {
      if (values[name] === undefined) return otherwise;
      if (!/^\d+$/.test(values[name])) throw new Error(`--${name}: not a whole number: ${values[name]}`);
      return Number(values[name]);
    };
    const [page, out] = positionals;
    return { page, out, frame: number('frame', 0), width: number('width', 1280), height: number('height', 800), dark: values.dark };
  } catch (error) {
    throw new Bad_input(error.message === usage ? usage : `${error.message}; ${usage}`);
  }
}

await run_command(main);
