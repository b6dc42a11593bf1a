// SPDX-License-Identifier: GPL-3.0-or-later
// The outcome of each frame: whether surfaces met, whether that was found, and else whether they were near.

/** @typedef {'none' | 'near' | 'confirmed' | 'missed'} Outcome */

export const outcome_words = { none: 'No collision', near: 'Near, no collision', confirmed: 'Collision, confirmed', missed: 'Collision, missed' };

/** @param {import('./container.mjs').Stage_record} stage @returns {Outcome} */
export function outcome_of({ positive, found, near }) {
  if (found) return 'confirmed';
  if (positive) return 'missed';
  return near ? 'near' : 'none';
}

/**
 * Runs of consecutive frames for which `is` holds, as [first, count].
 * @param {number} frames
 * @param {(frame: number) => boolean} is
 * @returns {[number, number][]}
 */
export function runs(frames, is) {
  const found = [];
  for (let frame = 0; frame < frames; ++frame) {
    if (!is(frame)) continue;
    if (found.length > 0 && found.at(-1)[0] + found.at(-1)[1] === frame) ++found.at(-1)[1];
    else found.push([frame, 1]);
  }
  return found;
}

/** Whether the run finds every collision, so that only a mode that may miss some has a recall to show. */
export const misses_nothing = ({ header }) => ['exact', 'certified'].includes(header.mode);

/** Whether the run had a tolerance, so that its frames say whether objects are near. */
const has_tolerance = ({ stages }) => Boolean(stages?.some(({ near }) => typeof near === 'boolean'));

/**
 * The kinds of frames that the timeline marks, in the order of its lanes.
 * @param {import('./container.mjs').Page} page
 * @returns {{kind: string, name: string, about: string, is: (frame: number) => boolean}[]}
 */
export function frame_kinds(page) {
  const { stages } = page;
  const kinds = [];
  const add = (kind, name, about, is) => kinds.push({ kind, name, about, is });
  const outcome = (kind) => (frame) => outcome_of(stages[frame]) === kind;
  if (stages && misses_nothing(page) && !stages.some((stage) => outcome_of(stage) === 'missed')) {
    add('confirmed', 'colliding', 'surfaces intersect', outcome('confirmed'));
  } else if (stages) {
    add('positive', 'colliding', 'surfaces intersect', (frame) => stages[frame].positive);
    add('confirmed', 'confirmed', 'the run found a collision', outcome('confirmed'));
    add('missed', 'missed', 'surfaces intersect, and the run did not find it', outcome('missed'));
  }
  if (has_tolerance(page)) add('near', 'only near', 'objects are nearer than the tolerance, and do not collide', outcome('near'));
  const anew = new Set(repartitions(page));
  if (anew.size > 0) add('anew', anew.size === 1 ? 'repartition' : 'repartitions', 'an object gets new regions', (frame) => anew.has(frame));
  return kinds;
}

/** Frames of the page at which an object gets new regions. Labels that are states change all the time. */
function repartitions(page) {
  if (page.header.states) return [];
  const frames = page.objects.flatMap(({ partitions }) => partitions.map(({ frame }) => frame));
  return [...new Set(frames)].filter((frame) => frame > 0).sort((a, b) => a - b);
}
