// SPDX-License-Identifier: GPL-3.0-or-later
// glTF files of `lodestone convert` pass Khronos' validator without any message.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import validator from 'gltf-validator';

const program = process.env.LODESTONE ?? fileURLToPath(new URL('../../build/release/lodestone', import.meta.url));
const skip = fs.existsSync(program) ? false : `${program} is not built`;

const square = (z) => `OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 ${z}\n0 1 0\n3 0 1 2\n3 0 2 3\n`;

function folder_of_frames(t, count) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'gltf-'));
  t.after(() => fs.rmSync(folder, { recursive: true }));
  for (let i = 0; i < count; ++i) fs.writeFileSync(path.join(folder, `f${i}.off`), square(i / 7));
  return folder;
}

async function report(file) {
  return validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    externalResourceFunction: async (uri) =>
      new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))),
  });
}

for (const extension of ['glb', 'gltf']) {
  for (const [frames, options] of [[1, []], [2, []], [9, ['--regions', '2', '--fps', '24']]]) {
    test(`${frames} frames as .${extension} ${options.join(' ')}`, { skip }, async (t) => {
      const folder = folder_of_frames(t, frames);
      const file = path.join(folder, `the square.${extension}`);
      execFileSync(program, ['convert', path.join(folder, 'f*.off'), file, '--quiet', ...options]);
      const { issues, info } = await report(file);
      assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages));
      assert.equal(issues.numWarnings, 0, JSON.stringify(issues.messages));
      assert.equal(info.totalVertexCount, 4);
      assert.equal(info.totalTriangleCount, 2);
      assert.equal(info.animationCount, frames > 1 ? 1 : 0);
      assert.equal(info.hasMorphTargets, frames > 1);
    });
  }
}
