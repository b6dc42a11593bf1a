// SPDX-License-Identifier: GPL-3.0-or-later
// The library runs in a worker. Each question has a number, which its answer repeats, so that answers find their
// questions while several are asked at once.

/**
 * Runs in the worker. The page passes it on as text, so it must not refer to anything outside itself.
 * @param {any} scope  the worker's global object
 * @param {Promise<any>} loading  of the library
 */
export function serve(scope, loading) {
  const check = (library, files) => {
    const paths = [];
    try {
      files.forEach(({ name, bytes }, i) => {
        library.FS.mkdirTree(`/${i}`);
        library.FS.writeFile(`/${i}/${name}`, new Uint8Array(bytes));
        paths.push(`/${i}/${name}`);
      });
      return library.check(paths[0], paths[1] ?? '');
    } finally {
      for (const path of paths) library.FS.unlink(path);
    }
  };
  scope.onmessage = async ({ data: { id, files } }) => {
    try {
      scope.postMessage({ id, answer: check(await loading, files) });
    } catch (error) {
      scope.postMessage({ id, answer: { error: `The check failed: ${error.message ?? error}` } });
    }
  };
}

/** Asks a worker that runs `serve`, and starts it when it is needed. */
export class Questions {
  /** @param {() => Worker} start */
  constructor(start) {
    this.start = start;
    this.worker = null;
    this.asked = 0;
    this.waiting = new Map();
  }

  /** @returns {Promise<any>} what the library says of the files; `error` if it cannot */
  ask(files) {
    this.worker ??= this.#started();
    return new Promise((resolve) => {
      const id = ++this.asked;
      this.waiting.set(id, resolve);
      this.worker.postMessage({ id, files });
    });
  }

  #started() {
    const worker = this.start();
    worker.onmessage = ({ data: { id, answer } }) => this.#answer(id, answer);
    worker.onerror = ({ message }) => {
      // The library may be broken: the next question starts it anew.
      worker.terminate();
      this.worker = null;
      for (const id of [...this.waiting.keys()]) this.#answer(id, { error: `The check failed: ${message}` });
    };
    return worker;
  }

  #answer(id, answer) {
    this.waiting.get(id)?.(answer);
    this.waiting.delete(id);
  }
}
