// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer's template: one HTML file, complete except for a title and a block of data.
import fs from 'node:fs';
import { bundle } from './bundle.mjs';

const placeholders = ['@LODESTONE_TITLE@', '@LODESTONE_DATA@'];

/** @returns {Promise<string>} */
export async function viewer_template() {
  const { script, licences } = await bundle('viewer/main.mjs');
  if (/<\/script/i.test(script)) throw new Error('the script would end early');
  const parts = { title: placeholders[0], data: placeholders[1], style: read('style.css'), licences: licences.replaceAll('--', '- -'), script };
  const template = read('page.html').replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
  // The program searches the template for these marks, so they must not occur elsewhere.
  for (const placeholder of placeholders)
    if (template.split(placeholder).length !== 2) throw new Error(`${placeholder} does not stand in the template exactly once`);
  return template;
}

const read = (name) => fs.readFileSync(new URL(`../viewer/${name}`, import.meta.url), 'utf8');
