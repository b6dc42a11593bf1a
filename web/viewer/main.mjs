// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in the page: reads the block of data and puts the parts together.
import { read_page, Too_old } from './container.mjs';
import { Damaged } from './decode.mjs';
import { by_id, number_text } from './dom.mjs';
import { listen_to_keys } from './keys.mjs';
import { layers, Shown } from './layers.mjs';
import { rendered_markdown } from './markdown.mjs';
import { line_of, make_numbers } from './numbers.mjs';
import { make_panel } from './panel.mjs';
import { Player } from './player.mjs';
import { Plots } from './plots.mjs';
import { View, webgl_of } from './scene.mjs';
import { Theme } from './theme.mjs';
import { Timeline } from './timeline.mjs';
import { make_transport, show_frame_number } from './transport.mjs';

async function main() {
  const theme = new Theme(by_id('theme'));
  const began = performance.now();
  const page = await read_page(by_id('lodestone-data').textContent);
  by_id('lodestone-data').textContent = '';  // Megabytes of text that are not read again.
  by_id('waiting').remove();
  const stats = { decode_ms: performance.now() - began };
  const player = new Player(page.header);
  const shown = new Shown(page);
  show_title(page);
  by_id('help-button').hidden = page.header.frames === 0;
  const view = page.header.frames > 0 ? show_geometry(page, player, shown, theme) : undefined;
  if (page.header.report) by_id('report').append(...rendered_markdown(page.header.report));
  by_id('report').hidden = !page.header.report;
  const plots = new Plots(page, player);
  player.on_change(() => plots.follow());
  document.documentElement.dataset.ready = 'yes';
  Object.assign(stats, view?.stats, { ready_ms: performance.now() });
  // The plots come last: they take a second, which the picture need not wait for.
  const plots_ready = new Promise((resolve) => setTimeout(() => theme.on_change((scheme) => plots.draw(scheme).then(resolve)), 50));
  return { page, player, shown, view, stats, plots_ready };
}

const counted_frames = (count) => `${number_text(count)} ${count === 1 ? 'frame' : 'frames'}`;

function show_title({ header, objects }) {
  by_id('title').textContent = by_id('title').title = header.title || document.title;
  const facts = [];
  if (header.mode) facts.push(`mode ${header.mode}`);
  if (header.strategy) facts.push(`regions by ${header.strategy}`);
  if (header.frame_step > 1) facts.push(`${counted_frames(header.frames)} shown, one of every ${number_text(header.frame_step)}`);
  else if (header.frames > 1) facts.push(counted_frames(header.frames));
  if (objects.length > 2) facts.push(`${objects.length} objects`);
  by_id('subtitle').textContent = facts.join(' · ');
  by_id('note').textContent = header.note ?? '';
  by_id('note').hidden = !header.note;
  document.body.classList.toggle('noted', Boolean(header.note));
}

/** Everything about frames: picture, panel, timeline, numbers. */
function show_geometry(page, player, shown, theme) {
  by_id('viewer').hidden = false;
  by_id('time').hidden = by_id('frame-place').hidden = player.frames < 2;
  by_id('numbers').hidden = !page.numbers && !page.stages;
  if (page.header.kind === 'partition') by_id('numbers-title').textContent = 'This partition';
  by_id('key-hint').hidden = player.frames < 2;
  document.body.classList.toggle('still', player.frames < 2);
  if (player.frames > 1) make_transport(page, player, new Timeline(by_id('timeline'), page, player));
  show_frame_number(page, player);
  const show_objects = make_panel(page, shown, () => player.frame);
  const show_numbers = make_numbers(page);
  const canvas = by_id('canvas');
  const context = webgl_of(canvas);
  by_id('no-webgl').hidden = context !== null;
  by_id('reset').hidden = canvas.hidden = context === null;
  const view = context ? new View(canvas, context, page, shown, () => player.playing) : undefined;
  player.on_change(() => {
    view?.show(player.frame);
    show_objects();
    show_numbers(player.frame);
  });
  shown.on_change(() => view?.refresh());
  theme.on_change((scheme) => view?.set_scheme(scheme));
  view?.draw();
  by_id('reset').addEventListener('click', () => view?.reset());
  listen_to_keys({ player, shown, reset: () => view?.reset(), turn: (...by) => view?.turn(...by) });
  return view;
}

const sentence = (text) => `${text}.`.replace(/^./, (c) => c.toUpperCase());

/** What happened, and what helps. */
function words_for(error) {
  if (error instanceof Damaged) return [sentence(error.message), 'The file may have been cut off or altered on its way; write or copy it again.'];
  if (error instanceof Too_old) return [sentence(error.message), 'Open the page in a newer browser.'];
  return [`The viewer failed: ${error.message}`, 'This is a fault of the viewer.'];
}

function complain(error) {
  by_id('waiting')?.remove();
  by_id('viewer').hidden = true;
  by_id('problem').hidden = false;
  [by_id('problem-text').textContent, by_id('problem-advice').textContent] = words_for(error);
  document.documentElement.dataset.ready = 'no';
}

const started = main();
started.catch(complain);

/** For tests, and for inspecting a run from the browser's console. */
window.lodestone = {
  ready: started.then(({ page, player, shown, view, stats, plots_ready }) => {
    const layer_switch = (key) => ({ enumerable: true, get: () => shown.layers[key], set: (on) => shown.set_layer(key, Boolean(on)) });
    const switches = Object.fromEntries(layers.map(({ key }) => [key, layer_switch(key)]));
    Object.assign(window.lodestone, {
      frames: player.frames,
      frame: () => player.frame,
      goto: (frame) => player.goto(frame),
      numbers: () => line_of(page, player.frame),
      layers: Object.defineProperties({}, switches),
      player, view,
      plots_ready,
    });
    Object.defineProperty(window.lodestone, 'stats', { get: () => ({ ...stats, ...view?.stats, settled: view?.settled ?? true }) });
  }),
};
window.lodestone.ready.catch(() => {});
