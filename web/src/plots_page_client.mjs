// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in the page of plots: draws them, and again when the colour scheme or the kind of screen changes.
import embed from 'vega-embed';
import { is_single_view, plot_config } from './plot_style.mjs';

const { plots, tables } = JSON.parse(document.getElementById('plots').textContent, (key, value) =>
  key === 'data' && Number.isInteger(value?.table) ? { name: `table ${value.table}` } : value,
);
const datasets = Object.fromEntries(tables.map((values, i) => [`table ${i}`, values]));
const dark = matchMedia('(prefers-color-scheme: dark)');
const narrow = matchMedia('(max-width: 640px)');
let drawn = [];

/** The heading stands beside the plot already; the width is that of the page. */
function fit(spec) {
  const fitted = { ...spec, datasets, title: undefined };
  if (is_single_view(spec)) return { ...fitted, width: spec.width ?? 'container' };
  return narrow.matches ? in_one_column(fitted) : fitted;
}

/** Small multiples that wrap stand one below the other. */
function in_one_column(spec) {
  const facet = spec.encoding?.facet;
  if (facet) return { ...spec, columns: undefined, encoding: { ...spec.encoding, facet: { ...facet, columns: 1 } } };
  return spec.columns ? { ...spec, columns: 1 } : spec;
}

function page_config() {
  const config = plot_config(dark.matches ? 'dark' : 'light', 'system-ui, sans-serif');
  // A legend beside the plot would take a third of a phone's width.
  return narrow.matches ? { ...config, legend: { ...config.legend, orient: 'bottom', columns: 3, layout: { bottom: { direction: 'vertical' } } } } : config;
}

async function draw() {
  drawn.forEach((result) => result.finalize());
  drawn = await Promise.all(
    plots.map(({ name, spec }) =>
      embed(document.getElementById(name), fit(spec), {
        mode: 'vega-lite',
        renderer: 'svg',
        config: page_config(),
        actions: false,
        tooltip: { theme: dark.matches ? 'dark' : 'light' },
      }),
    ),
  );
  document.documentElement.dataset.drawn = 'yes';
}

dark.addEventListener('change', draw);
narrow.addEventListener('change', draw);
draw();
