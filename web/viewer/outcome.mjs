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
export const has_tolerance = ({ stages }) => Boolean(stages?.some(({ near }) => typeof near === 'boolean'));

/** Frames of the page at which an object gets new regions. Labels that are states change all the time. */
export function repartitions(page) {
  if (page.header.states) return [];
  const frames = page.objects.flatMap(({ partitions }) => partitions.map(({ frame }) => frame));
  return [...new Set(frames)].filter((frame) => frame > 0).sort((a, b) => a - b);
}
