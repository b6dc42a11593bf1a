// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the page that checks meshes in a browser: build_browser MODULE.js OUT_FILE.
import fs from 'node:fs';
import { bundle } from './src/bundle.mjs';
import { Bad_input, run_command, write_whole } from './src/command.mjs';
import { viewer_template } from './src/viewer_template.mjs';

const base64 = (text) => Buffer.from(text).toString('base64');
const read = (name) => fs.readFileSync(new URL(`browser/${name}`, import.meta.url), 'utf8');

await run_command(async (words) => {
  if (words.length !== 2 || words.some((word) => word.startsWith('-'))) throw new Bad_input('usage: build_browser MODULE.js OUT_FILE');
  const { script, licences } = await bundle('browser/main.mjs');
  const parts = {
    style: read('style.css'),
    template: base64(await viewer_template()),
    module: base64(fs.readFileSync(words[0], 'utf8')),
    script,
    licences: licences.replaceAll('--', '- -'),
  };
  write_whole(words[1], read('page.html').replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]));
});
