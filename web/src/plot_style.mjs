// SPDX-License-Identifier: GPL-3.0-or-later
// The style of plots, in files and on the page.

const inks = {
  light: { text: '#24292f', faint: '#57606a', line: '#e3e6ea', marks: '#4269d0' },
  dark: { text: '#e6e8eb', faint: '#a3abb4', line: '#30363d', marks: '#7d9bf0' },
};

// Hues that are distinguishable on white and on near-black (those of Observable Plot, without the yellow).
const hues = ['#4269d0', '#ff725c', '#3ca951', '#e0a100', '#a463f2', '#38b2a3', '#ff8ab7', '#9c6b4e', '#97bbf5', '#9498a0'];

/** A Vega-Lite configuration; a specification's own settings override it. */
export function plot_config(scheme, font) {
  const { text, faint, line, marks } = inks[scheme];
  return {
    font,
    background: scheme === 'light' ? 'white' : 'transparent',
    mark: { color: marks, tooltip: true },
    rule: { color: faint },
    text: { color: text },
    axis: { labelColor: faint, titleColor: text, gridColor: line, domainColor: line, tickColor: line, labelFontSize: 12, titleFontSize: 12 },
    legend: { labelColor: text, titleColor: text, labelFontSize: 12, titleFontSize: 12, symbolBaseFillColor: faint, symbolBaseStrokeColor: faint },
    header: { labelColor: text, titleColor: text, labelFontSize: 12, titleFontSize: 12 },
    title: { color: text, subtitleColor: faint, fontSize: 15, anchor: 'start', offset: 12 },
    view: { stroke: 'transparent', continuousHeight: 300 },
    range: { category: hues },
  };
}

/** Whether a specification is a single or layered plot, which can take the width of the page. */
export function is_single_view(spec) {
  const { row, column, facet } = spec.encoding ?? {};
  return Boolean(spec.mark || spec.layer) && !row && !column && !facet && !spec.repeat;
}
