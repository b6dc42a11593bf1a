// SPDX-License-Identifier: GPL-3.0-or-later
// Questions of the browser page to the worker that runs the library.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Questions, serve } from '../browser/worker.mjs';

/** Workers that keep what they are asked, for the test to answer. */
function fake_workers() {
  const workers = [];
  const start = () => {
    const worker = { asked: [], ended: false, postMessage: (message) => worker.asked.push(message), terminate: () => (worker.ended = true) };
    workers.push(worker);
    return worker;
  };
  return { workers, questions: new Questions(start) };
}

/** A worker's scope with a library whose files are in a map. */
function fake_library(check) {
  const files = new Map();
  const FS = { mkdirTree() {}, writeFile: (path, bytes) => files.set(path, bytes), unlink: (path) => files.delete(path) };
  const scope = { said: [], postMessage: (message) => scope.said.push(message) };
  serve(scope, Promise.resolve({ FS, check: (...paths) => check(...paths.map((path) => files.get(path))) }));
  return { files, scope };
}

const file = (name, ...bytes) => ({ name, bytes: Uint8Array.from(bytes).buffer });

test('each question gets its own answer, whatever the order of the answers', async () => {
  const { workers, questions } = fake_workers();
  const answers = [questions.ask(['one']), questions.ask(['one', 'two'])];
  assert.equal(workers.length, 1);
  const [{ id: first, files }, { id: second }] = workers[0].asked;
  assert.deepEqual(files, ['one']);
  workers[0].onmessage({ data: { id: second, answer: 'of both' } });
  workers[0].onmessage({ data: { id: first, answer: 'of one' } });
  assert.deepEqual(await Promise.all(answers), ['of one', 'of both']);
});

test('a worker that fails answers all that wait, ends, and is replaced', async () => {
  const { workers, questions } = fake_workers();
  const answers = [questions.ask([]), questions.ask([])];
  workers[0].onerror({ message: 'out of memory' });
  for (const answer of await Promise.all(answers)) assert.deepEqual(answer, { error: 'The check failed: out of memory' });
  assert.ok(workers[0].ended);
  const next = questions.ask([]);
  workers[1].onmessage({ data: { id: workers[1].asked[0].id, answer: 'yes' } });
  assert.equal(await next, 'yes');
});

test('the worker repeats the number of the question, and leaves no files', async () => {
  const { files, scope } = fake_library((a, b) => `${a} ${b}`);
  await scope.onmessage({ data: { id: 7, files: [file('a.off', 1), file('b.off', 2)] } });
  await scope.onmessage({ data: { id: 8, files: [file('a.off', 3)] } });
  assert.deepEqual(scope.said, [{ id: 7, answer: '1 2' }, { id: 8, answer: '3 undefined' }]);
  assert.equal(files.size, 0);
});

test('a check that throws is an answer with an error, and leaves no files', async () => {
  const { files, scope } = fake_library(() => {
    throw new Error('broken');
  });
  await scope.onmessage({ data: { id: 3, files: [file('a.off', 1)] } });
  assert.deepEqual(scope.said, [{ id: 3, answer: { error: 'The check failed: broken' } }]);
  assert.equal(files.size, 0);
});

test('what the worker runs refers to nothing outside itself', async () => {
  const scope = { said: [], postMessage: (message) => scope.said.push(message) };
  const run = new Function('self', 'loading', `"use strict"; (${serve})(self, loading);`);
  run(scope, Promise.resolve({ FS: { mkdirTree() {}, writeFile() {}, unlink() {} }, check: () => 'yes' }));
  await scope.onmessage({ data: { id: 1, files: [file('a.off', 1)] } });
  assert.deepEqual(scope.said, [{ id: 1, answer: 'yes' }]);
});
