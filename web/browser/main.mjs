// SPDX-License-Identifier: GPL-3.0-or-later
// Runs in the page: takes files, asks the library, and shows the answer in the viewer.
import { Questions, serve } from './worker.mjs';

const by_id = (id) => document.getElementById(id);
const text_of = (id) => new TextDecoder().decode(Uint8Array.from(atob(by_id(id).textContent.trim()), (c) => c.charCodeAt(0)));

const questions = new Questions(() =>
  new Worker(URL.createObjectURL(new Blob([text_of('module'), `;(${serve})(self, lodestone_module());`], { type: 'text/javascript' }))));

function base64(bytes) {
  let binary = '';
  for (let i = 0; i < bytes.length; i += 0x8000) binary += String.fromCharCode(...bytes.subarray(i, i + 0x8000));
  return btoa(binary);
}

const escaped = (text) => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

/** Files that are dropped on the viewer are for this page, which the frame does not tell of them otherwise. */
const passes_drops_on = `<script>
addEventListener('dragover', (event) => event.preventDefault());
addEventListener('drop', (event) => {
  event.preventDefault();
  parent.postMessage([...event.dataTransfer.files], '*');
});
<\/script>`;

function show(answer, names) {
  by_id('answer').classList.toggle('problem', Boolean(answer.error));
  if (answer.error) {
    by_id('viewer').srcdoc = '';
    by_id('answer').textContent = answer.error.replaceAll(/\/[01]\//g, '');
    return;
  }
  const subject = names.length > 1 ? 'They' : 'It';
  const time = `${answer.milliseconds < 10 ? answer.milliseconds.toFixed(1) : Math.round(answer.milliseconds)} ms`;
  const count = `${answer.contacts} face ${answer.contacts === 1 ? 'pair' : 'pairs'}`;
  by_id('answer').textContent = answer.collides
    ? `${subject} intersect${names.length > 1 ? '' : 's itself'}: ${count}, found in ${time}.`
    : `${subject} ${names.length > 1 ? 'do not intersect' : 'does not intersect itself'}: checked in ${time}.`;
  by_id('viewer').srcdoc = text_of('template')
    .replace('@LODESTONE_DATA@', () => base64(answer.data))  // first, since a name may be that of the mark
    .replaceAll('@LODESTONE_TITLE@', () => escaped(names.join(' and '))) + passes_drops_on;
  by_id('viewer').hidden = false;
}

let chosen = [];
let asked = 0;
async function take(list) {
  const files = [...list];
  if (files.length === 0) return;
  chosen = [...(chosen.length === 1 ? chosen : []), ...files].slice(-2);
  by_id('chosen').textContent = chosen.map(({ name }) => name).join(' and ') + (chosen.length === 1 ? '; add a second one?' : '');
  by_id('clear').hidden = false;
  by_id('answer').classList.remove('problem');
  by_id('answer').textContent = 'Checking …';
  by_id('viewer').hidden = true;  // It still shows the earlier meshes.
  const question = ++asked;
  const names = chosen.map(({ name }) => name);
  const read = async (file) => ({ name: file.name.replaceAll('/', '_'), bytes: await file.arrayBuffer() });
  const answer = await Promise.all(chosen.map(read)).then(
    (contents) => questions.ask(contents),
    () => ({ error: `${names.join(' or ')} cannot be read: a file has been changed or moved since it was chosen, or is a folder. Choose it again.` }));
  if (question === asked) show(answer, names);
}

function clear() {
  chosen = [];
  ++asked;
  by_id('chosen').textContent = 'or drop them anywhere here';
  by_id('answer').textContent = '';
  by_id('clear').hidden = by_id('viewer').hidden = true;
  by_id('viewer').srcdoc = '';
}

by_id('files').addEventListener('change', ({ target }) => {
  take(target.files);
  target.value = '';
});
by_id('clear').addEventListener('click', clear);
document.addEventListener('dragover', (event) => {
  event.preventDefault();
  by_id('zone').classList.add('over');
});
document.addEventListener('dragleave', () => by_id('zone').classList.remove('over'));
addEventListener('message', ({ source, data }) => {
  if (source === by_id('viewer').contentWindow && Array.isArray(data)) take(data.filter((file) => file instanceof File));
});
document.addEventListener('drop', (event) => {
  event.preventDefault();
  by_id('zone').classList.remove('over');
  take(event.dataTransfer.files);
});
