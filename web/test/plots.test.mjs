// SPDX-License-Identifier: GPL-3.0-or-later
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url));
const specs = path.join(here, 'plots');
const plot_names = ['by_mesh', 'distortion', 'time'];

/** A temporary folder with the example's data, removed after the test. */
function data_folder(t) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'plots-'));
  t.after(() => fs.rmSync(folder, { recursive: true }));
  fs.cpSync(path.join(here, 'data'), folder, { recursive: true });
  return folder;
}

function run_plots(spec_folder, out) {
  return spawnSync(process.execPath, [path.join(here, '..', 'plots.mjs'), spec_folder, out, '--title', 'A <b> & "c"'], { encoding: 'utf8' });
}

function results(folder) {
  const files = ['plots.html', ...plot_names.map((name) => `plots/${name}.svg`)];
  return files.map((file) => fs.readFileSync(path.join(folder, file), 'utf8'));
}

/** Whether elements are properly nested and closed, and text has no markup. */
function is_well_formed(xml) {
  const open = [];
  const rest = xml.replace(/<(\/?)([\w:]+)((?:\s+[\w:-]+="[^"<]*")*)\s*(\/?)>/g, (_, closes, name, _attributes, empty) => {
    if (closes) return open.pop() === name ? '' : '<';
    if (!empty) open.push(name);
    return '';
  });
  return open.length === 0 && !/[<>]|&(?!\w+;|#\d+;)/.test(rest);
}

const count = (text, part) => text.split(part).length - 1;

/** URLs that a page loads: in its elements, outside its scripts, and in its style. */
function loads(html) {
  const markup = html.replace(/(<script[^>]*>)[^]*?<\/script>/g, '$1').replace(/<!--[^]*?-->/g, '');
  return [...markup.matchAll(/(?:src|href|srcset|data|action)\s*=\s*"([^"]*)"|url\(([^)]*)\)|@import\s+(\S+)/g)].map((m) => m[1] ?? m[2] ?? m[3]);
}

function broken_spec(t, text) {
  const folder = data_folder(t);
  fs.writeFileSync(path.join(folder, 'broken.vl.json'), typeof text === 'string' ? text : JSON.stringify(text));
  const run = run_plots(folder, folder);
  assert.equal(run.status, 1);
  assert.match(run.stderr, /^error: .*broken\.vl\.json: .*\n$/);
  assert.ok(!fs.existsSync(path.join(folder, 'plots')) && !fs.existsSync(path.join(folder, 'plots.html')));
  return run.stderr;
}

test('every specification becomes a well-formed SVG with a mark for each row, and all become a page that loads nothing', (t) => {
  const out = data_folder(t);
  const run = run_plots(specs, out);
  assert.equal(run.stderr, '');
  assert.equal(run.status, 0);
  const [html, by_mesh, distortion, time] = results(out);
  [by_mesh, distortion, time].forEach((svg) => assert.ok(is_well_formed(svg)));
  const rows = JSON.parse(fs.readFileSync(path.join(here, 'data/table.json'), 'utf8'));
  assert.equal(count(time, 'aria-roledescription="point"'), rows.length);
  assert.equal(count(distortion, 'aria-roledescription="point"'), rows.filter((row) => row.mesh === 'teapot').length);
  assert.equal(count(distortion, 'aria-roledescription="line mark"'), new Set(rows.map((row) => row.strategy)).size);
  assert.equal(count(by_mesh, 'aria-roledescription="bar"'), new Set(rows.map((row) => row.mesh + row.strategy)).size);

  assert.deepEqual(loads(html), ['data:,']);
  assert.match(html, /<title>A &lt;b&gt; &amp; &quot;c&quot;<\/title>/);
  assert.match(html, /<h2>Time to partition<\/h2>\n<p>Milliseconds on one core/);
  assert.deepEqual(fs.readdirSync(out).sort(), ['example.json', 'plots', 'plots.html', 'table.json']);
});

test('two runs give the same bytes', (t) => {
  const outs = [data_folder(t), data_folder(t)];
  outs.forEach((out) => run_plots(specs, out));
  assert.deepEqual(results(outs[0]), results(outs[1]));
});

const points = (x) => ({ data: { name: 'table' }, mark: 'point', encoding: { x: { field: x, type: 'quantitative' } } });

test('a specification that is not JSON is named', (t) => {
  assert.match(broken_spec(t, '{ "mark": '), /not JSON/);
});

test('data that do not exist are named', (t) => {
  assert.match(broken_spec(t, { ...points('ms'), data: { url: 'nowhere.json' } }), /nowhere\.json does not exist/);
});

test('data are never read from outside the folder of results', (t) => {
  for (const url of ['../table.json', '/etc/hosts', 'https://host.invalid/table.json'])
    assert.match(broken_spec(t, { ...points('ms'), data: { url } }), /outside/);
});

test('data that are no list of rows are named', (t) => {
  assert.match(broken_spec(t, { ...points('ms'), data: { url: 'example.json' } }), /not a list of rows/);
});

test('a field that is in no row is named, in an encoding and in an expression', (t) => {
  assert.match(broken_spec(t, points('milliseconds')), /field "milliseconds" is in no row/);
  assert.match(broken_spec(t, { ...points('ms'), transform: [{ filter: 'datum.nothing > 1' }] }), /field "nothing"/);
});

test('a field that a transform computes is known', (t) => {
  const folder = data_folder(t);
  const spec = { ...points('seconds'), transform: [{ calculate: 'datum.ms / 1000', as: 'seconds' }] };
  fs.writeFileSync(path.join(folder, 'computed.vl.json'), JSON.stringify(spec));
  assert.equal(run_plots(folder, folder).stderr, '');
});

test('what Vega-Lite cannot draw is named', (t) => {
  assert.match(broken_spec(t, { ...points('ms'), mark: 'blob' }), /Vega-Lite cannot draw it/);
});

test('a folder without specifications is named', (t) => {
  const run = run_plots(path.join(here, 'data'), data_folder(t));
  assert.equal(run.status, 1);
  assert.match(run.stderr, /^error: .*data: holds no \*\.vl\.json\n$/);
});
