// SPDX-License-Identifier: GPL-3.0-or-later
// A headless browser, for WebGL.
import fs from 'node:fs';
import { chromium } from 'playwright-core';
import { Bad_input } from './command.mjs';

const executable = process.env.CHROMIUM ?? '/usr/bin/chromium';
const in_software = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];

/**
 * Starts Debian's Chromium with software rendering, so that pictures do not depend on a graphics card.
 * @param {string[]} [graphics]  Chromium's rendering options
 */
export async function start_browser(graphics = in_software) {
  if (!fs.existsSync(executable)) throw new Bad_input(`${executable}: no such program; install the package chromium, or set CHROMIUM`);
  return chromium.launch({ executablePath: executable, args: graphics });
}
