// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the Vega-Lite specifications of a folder: OUT/plots/NAME.svg for each, and OUT/plots.html with all.
import path from 'node:path';
import { parseArgs } from 'node:util';
import { parse, resetSVGClipId, View } from 'vega';
import { compile } from 'vega-lite';
import { Bad_input, run_command, write_whole } from './src/command.mjs';
import { plots_page } from './src/plots_page.mjs';
import { read_plots } from './src/plot_spec.mjs';
import { is_single_view, plot_config } from './src/plot_style.mjs';

const usage = 'usage: plots DIR_WITH_SPECS OUT [--title TITLE]';
const svg_width = 640;

async function main(words) {
  const { spec_folder, out, title } = read_arguments(words);
  const plots = read_plots(spec_folder, out);
  // All are drawn before the first is written, so that an error leaves existing files untouched.
  const pictures = [];
  for (const plot of plots) pictures.push(await plot_svg(plot, spec_folder));
  const page = await plots_page(title, plots);
  plots.forEach(({ name }, i) => write_whole(path.join(out, 'plots', `${name}.svg`), pictures[i]));
  write_whole(path.join(out, 'plots.html'), page);
}

function read_arguments(words) {
  try {
    const { values, positionals } = parseArgs({ args: words, allowPositionals: true, options: { title: { type: 'string' } } });
    if (positionals.length !== 2) throw new Error(usage);
    const [spec_folder, out] = positionals;
    return { spec_folder, out, title: values.title ?? path.basename(path.resolve(out)) };
  } catch (error) {
    throw new Bad_input(error.message === usage ? usage : `${error.message}; ${usage}`);
  }
}

/** Renders a specification as SVG text. */
async function plot_svg({ name, spec }, spec_folder) {
  const file = path.join(spec_folder, `${name}.vl.json`);
  const width = !spec.width || spec.width === 'container' ? svg_width : spec.width;
  const sized = is_single_view(spec) ? { ...spec, width } : spec;
  try {
    const { spec: compiled } = compile(sized, { config: { ...plot_config('light', 'sans-serif'), padding: 12 }, logger: logger_for(file) });
    resetSVGClipId();
    const view = new View(parse(compiled), { renderer: 'none', logger: logger_for(file) });
    const svg = await view.toSVG();
    view.finalize();
    return `${svg}\n`;
  } catch (error) {
    throw new Bad_input(`${file}: Vega-Lite cannot draw it: ${error.message.split('\n')[0]}`);
  }
}

/** Throws on errors, after which Vega would continue with an empty plot. */
function logger_for(file) {
  const ignore = () => logger;
  const logger = {
    level: ignore,
    error: (...words) => {
      throw new Error(words.map((word) => word.message ?? word).join(' '));
    },
    warn: (...words) => (console.error(`warning: ${file}: ${words.join(' ')}`), logger),
    info: ignore,
    debug: ignore,
  };
  return logger;
}

await run_command(main);
