// SPDX-License-Identifier: GPL-3.0-or-later
// How long viewer pages take to open: PAGE.html... [--rounds N]
import path from 'node:path';
import { parseArgs } from 'node:util';
import { pathToFileURL } from 'node:url';
import { start_browser } from './src/browser.mjs';
import { Bad_input, read_file, run_command } from './src/command.mjs';

const usage = 'usage: opening_times PAGE.html... [--rounds N]';

async function main(words) {
  const { files, rounds } = read_arguments(words);
  files.forEach((file) => read_file(file));
  const times = files.map(() => []);
  const browser = await start_browser();
  try {
    // In turn, so that what else the machine does slows all of them.
    for (let round = 0; round < rounds; ++round)
      for (const [i, file] of files.entries()) times[i].push(await opening_ms(browser, file));
  } finally {
    await browser.close();
  }
  console.log(table(files, times));
}

/** From the start of loading until the first picture is drawn. Plots come later. */
async function opening_ms(browser, file) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.goto(pathToFileURL(path.resolve(file)).href);
  await page.evaluate('lodestone.ready');
  const { ready_ms } = await page.evaluate('lodestone.stats');
  await page.close();
  return ready_ms;
}

function table(files, times) {
  const medians = times.map((list) => [...list].sort((a, b) => a - b)[list.length >> 1]);
  const rows = files.map((file, i) =>
    `| ${path.basename(file)} | ${Math.round(medians[i])} | ${Math.round(Math.max(...times[i]))} | ${(medians[i] / medians[0]).toFixed(2)} |`);
  return ['| page | median (ms) | longest (ms) | in times of the first |', '| --- | ---: | ---: | ---: |', ...rows].join('\n');
}

function read_arguments(words) {
  try {
    const { values, positionals } = parseArgs({ args: words, allowPositionals: true, options: { rounds: { type: 'string', default: '9' } } });
    if (positionals.length === 0) throw new Error(usage);
    if (!/^[1-9]\d*$/.test(values.rounds)) throw new Error(`--rounds: not a whole number from 1 on: ${values.rounds}`);
    return { files: positionals, rounds: Number(values.rounds) };
  } catch (error) {
    throw new Bad_input(error.message === usage ? usage : `${error.message}; ${usage}`);
  }
}

await run_command(main);
