// SPDX-License-Identifier: GPL-3.0-or-later
// Bundles a module and its imports into one script, for embedding in a page.
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const web = fileURLToPath(new URL('..', import.meta.url));

/**
 * @param {string} entry  path of a module, relative to this folder's parent
 * @returns {Promise<{script: string, licences: string}>}
 */
export async function bundle(entry) {
  const result = await build({
    entryPoints: [entry],
    absWorkingDir: web,
    bundle: true,
    minify: true,
    write: false,
    metafile: true,
    format: 'iife',
    target: 'es2020',
    charset: 'ascii',
    legalComments: 'none',
    logLevel: 'error',
  });
  return { script: result.outputFiles[0].text, licences: licences(Object.keys(result.metafile.inputs)) };
}

/** Bundled packages require their licences to be included. */
function licences(sources) {
  const packages = new Map();
  for (const folder of new Set(sources.map(package_folder).filter(Boolean))) {
    const { name, version, license } = JSON.parse(fs.readFileSync(path.join(web, folder, 'package.json'), 'utf8'));
    const text = licence_text(path.join(web, folder)) ?? license;
    packages.set(text, [...(packages.get(text) ?? []), `${name} ${version}`]);
  }
  const entries = [...packages].map(([text, names]) => `${names.sort().join(', ')}:\n\n${text}`);
  return entries.sort().join('\n\n');
}

/** node_modules/three/src/Three.js -> node_modules/three, @scope/name likewise; nothing for sources of this project. */
function package_folder(source) {
  return source.match(/^.*node_modules\/(@[^/]+\/)?[^/]+/)?.[0];
}

function licence_text(folder) {
  const file = fs.readdirSync(folder).find((name) => /^licen[cs]e/i.test(name));
  return file && fs.readFileSync(path.join(folder, file), 'utf8').trim();
}
