// SPDX-License-Identifier: GPL-3.0-or-later
// Plots below the picture. Plots over frames have a rule at the current frame; a click goes to that frame.
import embed from 'vega-embed';
import { fitted_plot, page_plot_config } from '../src/plot_fit.mjs';
import { by_id, element } from './dom.mjs';
import { frame_plots } from './frame_plots.mjs';

export class Plots {
  /**
   * @param {import('./container.mjs').Page} page
   * @param {import('./player.mjs').Player} player
   */
  constructor(page, player) {
    this.player = player;
    this.narrow = matchMedia('(max-width: 640px)');
    const over_frames = frame_plots(page, (frame) => player.scene_frame(frame));
    this.plots = [...over_frames, ...(page.header.plots ?? [])].map((plot, i) => this.#place(plot, i < over_frames.length));
    by_id('plots').hidden = this.plots.length === 0;
    this.narrow.addEventListener('change', () => this.draw(this.scheme));
  }

  /** Draws all plots, one at a time so that the page stays responsive. @param {'light' | 'dark'} scheme */
  async draw(scheme) {
    this.scheme = scheme;
    this.turn = {};
    const { turn } = this;
    for (const plot of this.plots) {
      await new Promise((resolve) => setTimeout(resolve));
      if (turn !== this.turn) return;
      await this.#draw_one(plot, scheme);
    }
  }

  /** Moves the rules to the current frame. */
  follow() {
    for (const plot of this.plots) if (plot.rule) this.#move_rule(plot);
  }

  #place({ name, title, description, spec }, over_frames) {
    const place = element('div', { className: 'plot', id: `plot-${name}` });
    const rule = over_frames ? element('div', { className: 'rule', hidden: true }) : undefined;
    const frame = element('div', { className: over_frames ? 'plot-frame over-frames' : 'plot-frame' }, place, ...(rule ? [rule] : []));
    by_id(over_frames ? 'frame-plots' : 'own-plots').append(
      element('figure', {}, element('figcaption', {}, element('h3', { textContent: title }), element('p', { textContent: description })), frame));
    if (over_frames) frame.addEventListener('click', (event) => this.#jump(plot, event));
    const described = { ...spec, description: `${title}. ${description}` };  // what a screen reader says of the picture
    const plot = { place, rule, spec: over_frames ? { ...described, height: 150 } : described };
    return plot;
  }

  async #draw_one(plot, scheme) {
    plot.view?.finalize();
    plot.view = undefined;
    try {
      const config = page_plot_config(scheme, this.narrow.matches);
      const options = { mode: 'vega-lite', renderer: 'svg', config, actions: false, tooltip: { theme: scheme } };
      plot.view = (await embed(plot.place, fitted_plot(plot.spec, this.narrow.matches), options)).view;
    } catch (error) {
      plot.place.textContent = `This plot cannot be drawn: ${error.message}`;
      return;
    }
    if (!plot.rule) return;
    plot.view.addResizeListener(() => this.#move_rule(plot));
    this.#move_rule(plot);
  }

  #move_rule({ view, rule }) {
    if (!view) return;
    const [left, top] = view.origin();
    const padding = view.padding();
    rule.hidden = false;
    const x = left + (padding.left ?? 0) + view.scale('x')(this.player.scene_frame());
    rule.style.transform = `translate(${x}px, ${top + (padding.top ?? 0)}px)`;
    rule.style.height = `${view.height()}px`;
  }

  #jump({ view, place }, event) {
    if (!view) return;
    const x = event.clientX - place.getBoundingClientRect().left - view.origin()[0] - (view.padding().left ?? 0);
    if (x < -20 || x > view.width() + 20) return;
    this.player.pause();
    this.player.goto(this.player.page_frame(view.scale('x').invert(x)));
  }
}
