// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in the page of plots: draws them, and redraws when the colour scheme or the kind of screen changes.
import embed from 'vega-embed';
import { fitted_plot, page_plot_config } from './plot_fit.mjs';

const { plots, tables } = JSON.parse(document.getElementById('data').textContent, (key, value) =>
  key === 'data' && Number.isInteger(value?.table) ? { name: `table ${value.table}` } : value,
);
const datasets = Object.fromEntries(tables.map((values, i) => [`table ${i}`, values]));
const dark = matchMedia('(prefers-color-scheme: dark)');
const narrow = matchMedia('(max-width: 640px)');
let drawn = [];

async function draw() {
  const scheme = dark.matches ? 'dark' : 'light';
  drawn.forEach((result) => result.finalize());
  drawn = (await Promise.all(plots.map((plot) => draw_one(plot, scheme)))).filter(Boolean);
  document.documentElement.dataset.drawn = 'yes';
}

/** One plot that fails leaves the others as they are. */
async function draw_one({ name, spec }, scheme) {
  const place = document.getElementById(`plot-${name}`);
  try {
    return await embed(place, fitted_plot({ ...spec, datasets }, narrow.matches), {
      mode: 'vega-lite',
      renderer: 'svg',
      config: page_plot_config(scheme, narrow.matches),
      actions: false,
      tooltip: { theme: scheme },
    });
  } catch (error) {
    place.textContent = `This plot cannot be drawn: ${error.message}`;
  }
}

dark.addEventListener('change', draw);
narrow.addEventListener('change', draw);
draw();
