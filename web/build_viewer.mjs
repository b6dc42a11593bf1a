// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the viewer's template: build_viewer OUT_FILE.
import { Bad_input, run_command, write_whole } from './src/command.mjs';
import { viewer_template } from './src/viewer_template.mjs';

await run_command(async (words) => {
  if (words.length !== 1 || words[0].startsWith('-')) throw new Bad_input('usage: build_viewer OUT_FILE');
  write_whole(words[0], await viewer_template());
});
