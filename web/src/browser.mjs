// SPDX-License-Identifier: GPL-3.0-or-later
// A browser without a window, for what needs WebGL.
import fs from 'node:fs';
import { chromium } from 'playwright-core';
import { Bad_input } from './command.mjs';

const executable = process.env.CHROMIUM ?? '/usr/bin/chromium';
const in_software = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/**
 * Starts Debian's Chromium; it draws in software, so that a picture does not depend on a graphics card.
 * @param {string[]} [graphics]  options of Chromium that say how it draws
 */
export async function start_browser(graphics = in_software) {
  if (!fs.existsSync(executable)) throw new Bad_input(`${executable}: no such program; install the package chromium, or set CHROMIUM`);
  return chromium.launch({ executablePath: executable, args: graphics });
}
