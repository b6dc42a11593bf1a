// SPDX-License-Identifier: GPL-3.0-or-later
// Shared by the commands of this folder: one-line errors, and files that appear whole or not at all.
import fs from 'node:fs';
import path from 'node:path';

/** An error in the user's input. Any other exception is a bug. */
export class Bad_input extends Error {}

/** Runs a command: a `Bad_input` becomes one line and exit code 1. */
export async function run_command(main) {
  try {
    await main(process.argv.slice(2));
  } catch (error) {
    if (!(error instanceof Bad_input)) throw error;
    console.error(`error: ${error.message}`);
    process.exitCode = 1;
  }
}

/** Writes a file under a temporary name in its folder, then renames it. */
export function write_whole(file, content) {
  const temporary = path.join(path.dirname(file), `.${path.basename(file)}.${process.pid}`);
  fs.mkdirSync(path.dirname(file), { recursive: true });
  try {
    fs.writeFileSync(temporary, content, { flush: true });
    fs.renameSync(temporary, file);
  } finally {
    fs.rmSync(temporary, { force: true });
  }
}

/** @returns {any} the content of a JSON file */
export function read_json(file) {
  const text = read_file(file).toString('utf8');
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Bad_input(`${file}: not JSON: ${error.message.replace(/\s+/g, ' ')}`);
  }
}

/** @returns {Buffer} */
export function read_file(file) {
  try {
    return fs.readFileSync(file);
  } catch (error) {
    throw new Bad_input(`${file}: ${error.code === 'ENOENT' ? 'no such file' : error.message}`);
  }
}
