// SPDX-License-Identifier: GPL-3.0-or-later
// How a plot fits a page: the width is that of its place, and a phone gets one column.
import { is_single_view, plot_config } from './plot_style.mjs';

/** The heading stands beside the plot already; the width is that of the page. */
export function fitted_plot(spec, narrow) {
  const fitted = { ...spec, title: undefined };
  if (is_single_view(spec)) return { ...fitted, width: spec.width ?? 'container' };
  return narrow ? in_one_column(fitted) : fitted;
}

/** Small multiples that wrap stand one below the other. */
function in_one_column(spec) {
  const facet = spec.encoding?.facet;
  if (facet) return { ...spec, columns: undefined, encoding: { ...spec.encoding, facet: { ...facet, columns: 1 } } };
  return spec.columns ? { ...spec, columns: 1 } : spec;
}

/** @param {'light' | 'dark'} scheme */
export function page_plot_config(scheme, narrow) {
  const config = plot_config(scheme, 'system-ui, sans-serif');
  // A legend beside the plot would take a third of a phone's width.
  return narrow ? { ...config, legend: { ...config.legend, orient: 'bottom', columns: 3, layout: { bottom: { direction: 'vertical' } } } } : config;
}
