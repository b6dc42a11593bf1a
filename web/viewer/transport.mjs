// SPDX-License-Identifier: GPL-3.0-or-later
// The playback buttons, and the legend of the timeline, whose entries go to the next such frame.
import { by_id, element, icon } from './dom.mjs';
import { frame_kinds, outcome_of, outcome_words } from './outcome.mjs';
import { speeds } from './player.mjs';

/**
 * @param {import('./container.mjs').Page} page
 * @param {import('./player.mjs').Player} player
 * @param {import('./timeline.mjs').Timeline} timeline
 */
export function make_transport(page, player, timeline) {
  const button = (name, picture, act) => {
    const made = element('button', { type: 'button', title: name, 'aria-label': name, className: 'round' }, icon(picture));
    made.addEventListener('click', act);
    return made;
  };
  const play = button('Play', 'play', () => player.toggle());
  play.id = 'play';
  const loop = button('Loop', 'loop', () => player.set_loop(!player.loop));
  loop.id = 'loop';
  const speed = element('select', { id: 'speed', title: 'Speed', 'aria-label': 'Speed' },
    ...speeds.map((value) => element('option', { value: String(value), textContent: `${value}×` })));
  speed.addEventListener('change', () => player.set_speed(Number(speed.value)));
  by_id('transport').append(
    button('First frame', 'first', () => player.step(-player.frames)),
    button('One frame back', 'back', () => player.step(-1)),
    play,
    button('One frame forward', 'forward', () => player.step(1)),
    button('Last frame', 'last', () => player.step(player.frames)),
    loop, speed,
  );
  make_zoom(timeline);
  make_legend(page, player);
  player.on_change(() => {
    const name = player.playing ? 'Pause' : 'Play';
    if (play.title !== name) {
      play.replaceChildren(icon(player.playing ? 'pause' : 'play'));
      play.title = name;
      play.setAttribute('aria-label', name);
    }
    loop.setAttribute('aria-pressed', String(player.loop));
    speed.value = String(player.speed);
  });
}

function make_zoom(timeline) {
  for (const [text, name, act] of [
    ['−', 'Show more frames', () => timeline.zoom(1 / 2)],
    ['+', 'Show fewer frames, larger', () => timeline.zoom(2)],
    ['All', 'Show all frames', () => timeline.show_all()],
  ]) {
    const made = element('button', { type: 'button', title: name, 'aria-label': name, textContent: text });
    made.addEventListener('click', act);
    by_id('zoom').append(made);
  }
}

function make_legend(page, player) {
  for (const { kind, name, about, is } of frame_kinds(page)) {
    const count = Array.from({ length: player.frames }, (_, frame) => frame).filter(is).length;
    const made = element('button', { type: 'button', className: `legend ${kind}`, title: `Go to the next frame in which ${about}`, disabled: count === 0 },
      element('span', { className: 'swatch' }), `${count} ${name}`);
    made.addEventListener('click', () => go_to_next(player, is));
    by_id('legend').append(made);
  }
}

function go_to_next(player, is) {
  player.pause();
  for (let by = 1; by <= player.frames; ++by) {
    const frame = (player.frame + by) % player.frames;
    if (is(frame)) return player.goto(frame);
  }
}

/** Number and outcome of the frame, above the picture; announced to screen readers when paused. */
export function show_frame_number(page, player) {
  const spoken = by_id('spoken');
  let later;
  player.on_change(() => {
    const stage = page.stages?.[player.frame];
    const outcome = stage ? outcome_of(stage) : 'none';
    by_id('frame-number').textContent = `Frame ${player.scene_frame()}`;
    by_id('frame-count').textContent = `/ ${player.scene_frame(player.frames - 1)}`;
    by_id('outcome').textContent = stage ? outcome_words[outcome] : '';
    by_id('outcome').className = outcome;
    clearTimeout(later);
    const words = `Frame ${player.scene_frame()}${stage ? `. ${outcome_words[outcome]}` : ''}`;
    if (!player.playing) later = setTimeout(() => (spoken.textContent = words), 300);
  });
}
