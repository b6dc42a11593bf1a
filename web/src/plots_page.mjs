// SPDX-License-Identifier: GPL-3.0-or-later
// One HTML page with all plots, their data and the code that draws them.
import fs from 'node:fs';
import { bundle } from './bundle.mjs';

/**
 * @param {string} title
 * @param {import('./plot_spec.mjs').Plot[]} plots
 * @returns {Promise<string>} self-contained HTML
 */
export async function plots_page(title, plots) {
  const { script, licences } = await bundle('src/plots_page_client.mjs');
  const { specs, tables } = shared_tables(plots.map(({ spec }) => spec));
  const named = plots.map(({ name }, i) => ({ name, spec: specs[i] }));
  const style = fs.readFileSync(new URL('plots_page.css', import.meta.url), 'utf8');
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<title>${escape_html(title)}</title>
<link rel="icon" href="data:,">
<style>
${style}</style>
</head>
<body>
<main>
<h1>${escape_html(title)}</h1>
${plots.map(section).join('\n')}
</main>
<script type="application/json" id="data">${embed_json({ plots: named, tables })}</script>
<!--
${licences.replaceAll('--', '- -')}
-->
<script>${script}</script>
</body>
</html>
`;
}

/**
 * Stores equal data of several plots once: each `values` becomes the index of a table.
 * @param {object[]} specs
 */
function shared_tables(specs) {
  const numbers = new Map();
  const share = (key, value) => {
    if (key !== 'data' || !Array.isArray(value?.values)) return value;
    const text = JSON.stringify(value.values);
    if (!numbers.has(text)) numbers.set(text, numbers.size);
    return { table: numbers.get(text) };
  };
  const shared = specs.map((spec) => JSON.parse(JSON.stringify(spec, share)));
  return { specs: shared, tables: [...numbers.keys()].map((text) => JSON.parse(text)) };
}

function section({ name, title, description }) {
  return `<section>
<h2>${escape_html(title)}</h2>
<p>${escape_html(description)}</p>
<div class="plot" id="plot-${escape_html(name)}"></div>
</section>`;
}

/** JSON that cannot end the enclosing script element. */
function embed_json(value) {
  return JSON.stringify(value).replaceAll('<', '\\u003c');
}

function escape_html(text) {
  return text.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
}
