// SPDX-License-Identifier: GPL-3.0-or-later
// Fits a plot to a page: the width of its container, and one column on a phone.
import { is_single_view, plot_config } from './plot_style.mjs';

/** Drops the title, since the page has a heading, and uses the width of the page. */
export function fitted_plot(spec, narrow) {
  const fitted = { ...spec, title: undefined };
  if (is_single_view(spec)) return { ...fitted, width: spec.width ?? 'container' };
  return narrow ? in_one_column(fitted) : fitted;
}

/** Puts wrapping small multiples one below the other. */
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
