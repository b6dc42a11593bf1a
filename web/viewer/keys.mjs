// SPDX-License-Identifier: GPL-3.0-or-later
// Control by keyboard, and the list of keys.
import { by_id, element } from './dom.mjs';
import { layers } from './layers.mjs';
import { runs } from './outcome.mjs';

const repeating = new Set(['arrowleft', 'arrowright', '+', '=', '-', ...'adwsqe']);

/**
 * @param {{player: import('./player.mjs').Player, shown: import('./layers.mjs').Shown, reset: () => void,
 *          turn: (angle: number, rise: number, nearer: number) => void}} parts
 */
export function listen_to_keys({ player, shown, reset, turn }) {
  const moves = player.frames > 1;
  const numbers = layer_numbers(shown);
  const dialog = make_help(moves, numbers, shown.available);
  by_id('layer-keys').append(...key_names(numbers));
  const in_time = (act) => (moves ? act : undefined);
  const acts = {
    ' ': in_time(() => player.toggle()),
    k: in_time(() => player.toggle()),
    ArrowLeft: in_time((event) => player.step(event.shiftKey ? -10 : -1)),
    ArrowRight: in_time((event) => player.step(event.shiftKey ? 10 : 1)),
    Home: in_time(() => player.step(-player.frames)),
    End: in_time(() => player.step(player.frames)),
    '+': in_time(() => player.change_speed(1)),
    '=': in_time(() => player.change_speed(1)),
    '-': in_time(() => player.change_speed(-1)),
    l: in_time(() => player.set_loop(!player.loop)),
    r: reset,
    a: () => turn(-0.15, 0, 1),
    d: () => turn(0.15, 0, 1),
    w: () => turn(0, 0.12, 1),
    s: () => turn(0, -0.12, 1),
    q: () => turn(0, 0, 1.15),
    e: () => turn(0, 0, 1 / 1.15),
    '?': () => (dialog.open ? dialog.close() : dialog.showModal()),
  };
  layers.forEach(({ key }, i) => {
    if (shown.available.some((layer) => layer.key === key)) acts[String(i + 1)] = () => shown.set_layer(key, !shown.layers[key]);
  });
  document.addEventListener('keydown', (event) => {
    const act = acts[event.key] ?? acts[event.key?.toLowerCase()];  // Caps Lock makes capital letters.
    if (!act || event.ctrlKey || event.metaKey || event.altKey || is_for_element(event)) return;
    if (dialog.open && event.key !== '?') return;
    event.preventDefault();
    // A key that is held repeats its steps, but does not play and pause by turns.
    if (!event.repeat || repeating.has(event.key.toLowerCase())) act(event);
  });
  by_id('help-button').addEventListener('click', () => dialog.showModal());
}

/** Space presses the button that has the focus; arrows choose in a list. */
function is_for_element({ key, target }) {
  if (target.closest?.('dialog:not([open])')) return false;  // It keeps the focus for a moment after closing.
  if (key === ' ' && target.closest?.('button, input, select, summary, a')) return true;
  return Boolean(target.closest?.('select, textarea, input:not([type=checkbox])')) && key !== '?';
}

/** The number keys of the layers that the page has; of three or more in a row the first and the last. */
function layer_numbers(shown) {
  const exists = (i) => shown.available.some(({ key }) => key === layers[i].key);
  return runs(layers.length, exists).map(([first, count]) => {
    const numbers = Array.from({ length: count }, (_, i) => String(first + i + 1));
    return count < 3 ? numbers.join(' ') : `${numbers[0]} … ${numbers.at(-1)}`;
  }).join(' ');
}

const key_names = (keys) => keys.split(' ').map((name) => (name === '…' ? '…' : element('kbd', { textContent: name })));

/**
 * @param {boolean} moves  whether the page has frames to move through
 * @param {string} numbers  keys of the layers
 * @param {import('./layers.mjs').Layer[]} available
 */
function make_help(moves, numbers, available) {
  const in_time = [
    ['space', 'play or pause'],
    ['← →', 'one frame back or forward; with shift, ten'],
    ['Home End', 'first or last frame'],
    ['+ −', 'faster or slower'],
    ['l', 'loop or not'],
  ];
  const keys = [
    ...(moves ? in_time : []),
    [numbers, `layers: ${available.map(({ name }) => name.toLowerCase()).join(', ')}`],
    ['a d w s', 'turn the view'],
    ['q e', 'farther, nearer'],
    ['r', 'reset the view'],
    ['?', 'this list'],
  ];
  const dialog = by_id('help');
  by_id('keys').append(...keys.flatMap(([key, what]) => [
    element('dt', {}, ...key_names(key)),
    element('dd', { textContent: what }),
  ]));
  by_id('timeline-help').hidden = !moves;
  by_id('help-close').addEventListener('click', () => dialog.close());
  dialog.addEventListener('click', (event) => event.target === dialog && dialog.close());
  return dialog;
}
