// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of the picture; those of the page are in style.css.

/**
 * The same colours as in files of `lodestone partition --out`: hues in steps of the golden section, with three
 * lightnesses.
 * @param {number} region
 * @returns {[number, number, number]} 0 to 255
 */
export function region_colour(region) {
  const hue = 6 * ((0.61803398874989485 * region) % 1);
  const lightness = 0.75 + (0.2 * (region % 3)) / 2;
  const channel = (offset) => {
    const distance = Math.abs(((hue + offset) % 6) - 3) - 1;
    return Math.round(255 * lightness * (0.25 + 0.75 * Math.min(1, Math.max(0, distance))));
  };
  return [channel(0), channel(4), channel(2)];
}

/** What a run knew of a part of a surface: nothing; where it can be; where it is. */
const state_colours = [[176, 180, 188], [112, 160, 222], [242, 152, 62]];

export const state_colour = (state) => state_colours[state % state_colours.length];

/** Colours of whole objects, without regions. */
const object_colours = [[154, 172, 200], [214, 186, 148], [160, 193, 168], [196, 166, 193], [190, 190, 160], [160, 188, 196]];

export const object_colour = (object) => object_colours[object % object_colours.length];

/** Marks on the surfaces, which can have any colour: a core in one colour, with a rim that separates it from the background. */
export const marks = {
  particle: { core: [1, 1, 1], rim: [0.07, 0.08, 0.1] },
  paired: [1, 0.82, 0.1],  // a particle or region of a candidate pair
  candidate: { core: [1, 0.82, 0.1], rim: [0.2, 0.14, 0] },
  segment: { core: [1, 1, 1], rim: [0.72, 0, 0.32] },
  trail: { core: [1, 1, 1], rim: [0.07, 0.08, 0.1] },
  // Faces in blue and faces in crimson differ for colour-blind readers too.
  face: { core: [0.86, 0.05, 0.4], rim: [0.25, 0, 0.12] },
  near_face: { core: [0, 0.4, 0.9], rim: [0, 0.1, 0.3] },
  gap: { core: [0.25, 0.6, 1], rim: [0, 0.16, 0.42] },
};

export const stage_background = { light: '#eceef1', dark: '#101316' };
