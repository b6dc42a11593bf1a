// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of coloured meshes: OUT_DIR/STEM.png for each, and on request a labelled sheet of all.
import path from 'node:path';
import { parseArgs } from 'node:util';
import { start_browser } from './src/browser.mjs';
import { bundle } from './src/bundle.mjs';
import { read_coloured_ply } from './src/coloured_ply.mjs';
import { Bad_input, run_command, write_whole } from './src/command.mjs';
import { repack_png } from './src/png.mjs';

const usage = 'usage: pictures OUT_DIR FILE.ply... [--sheet SHEET.png] [--columns N] [--size PIXELS] [--up y|z]';
const stem = (file) => path.basename(file, path.extname(file));

async function main(words) {
  const { out, files, sheet, columns, width, up } = read_arguments(words);
  // Finds broken files before the browser starts. Meshes are not kept, since they can be large.
  files.forEach((file) => read_coloured_ply(file, up));
  const browser = await start_browser();
  try {
    const page = await browser.newPage();
    await page.addScriptTag({ content: (await bundle('src/pictures_client.mjs')).script });
    for (const file of files) {
      const picture = await take_picture(page, read_coloured_ply(file, up), stem(file), width);
      write_whole(path.join(out, `${stem(file)}.png`), picture);
    }
    if (sheet) write_whole(sheet, png_of(await page.evaluate((n) => globalThis.take_sheet(n), columns)));
  } finally {
    await browser.close();
  }
}

function read_arguments(words) {
  const options = {
    sheet: { type: 'string' },
    columns: { type: 'string', default: '4' },
    size: { type: 'string', default: '720' },
    up: { type: 'string', default: 'z' },
  };
  const { values, positionals } = parse(words, options);
  const [out, ...files] = positionals;
  if (files.length === 0) throw new Bad_input(usage);
  if (!['y', 'z'].includes(values.up)) throw new Bad_input(`--up ${values.up}: expected y or z`);
  const twin = files.find((file, i) => files.findIndex((other) => stem(other) === stem(file)) < i);
  if (twin) throw new Bad_input(`${twin}: another file has the same name; both would be ${stem(twin)}.png`);
  return {
    out,
    files,
    sheet: values.sheet,
    columns: whole_number('--columns', values.columns, 1, 20),
    width: whole_number('--size', values.size, 64, 4096),
    up: values.up,
  };
}

function parse(words, options) {
  try {
    return parseArgs({ args: words, allowPositionals: true, options });
  } catch (error) {
    throw new Bad_input(`${error.message}; ${usage}`);
  }
}

function whole_number(option, text, least, most) {
  const number = Number(text);
  if (!Number.isInteger(number) || number < least || number > most)
    throw new Bad_input(`${option} ${text}: expected a whole number from ${least} to ${most}`);
  return number;
}

/** @param {import('./src/coloured_ply.mjs').Coloured_mesh} mesh */
async function take_picture(page, mesh, label, width) {
  const encoded = Object.fromEntries(Object.entries(mesh).map(([name, values]) => [name, to_base64(values)]));
  const picture = await page.evaluate((request) => globalThis.take_picture(request), { encoded, label, width });
  return png_of(picture);
}

const png_of = (text) => repack_png(Buffer.from(text, 'base64'));
const to_base64 = (values) => Buffer.from(values.buffer, values.byteOffset, values.byteLength).toString('base64');

await run_command(main);
