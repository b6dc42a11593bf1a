// SPDX-License-Identifier: GPL-3.0-or-later
// Reports: headings, paragraphs, lists, tables, code. All other Markdown is shown as plain text.
import { element } from './dom.mjs';

/** @param {string} text @returns {HTMLElement[]} */
export function rendered_markdown(text) {
  const lines = text.split(/\r?\n/);
  const blocks = [];
  for (let at = 0; at < lines.length; ) {
    const [block, next] = block_at(lines, at);
    if (block) blocks.push(block);
    at = next;
  }
  return blocks;
}

/** @returns {[HTMLElement | undefined, number]} the block that begins in a line, and the line after it */
function block_at(lines, at) {
  const line = lines[at];
  if (line.trim() === '') return [undefined, at + 1];
  if (/^\s*```/.test(line)) return code(lines, at);
  const heading = line.match(/^(#{1,6})\s+(.*?)\s*#*$/);
  if (heading) return [element(`h${Math.min(6, heading[1].length + 1)}`, {}, ...inline(heading[2])), at + 1];
  if (is_row(line) && is_rule(lines[at + 1])) return table(lines, at);
  if (/^\s*([-*]|\d+\.)\s/.test(line)) return list(lines, at);
  return paragraph(lines, at);
}

function code(lines, at) {
  let end = at + 1;
  while (end < lines.length && !/^\s*```/.test(lines[end])) ++end;
  return [element('pre', { tabIndex: 0 }, element('code', { textContent: lines.slice(at + 1, end).join('\n') })), end + 1];
}

const is_row = (line) => /^\s*\|.*\|\s*$/.test(line ?? '');
const is_rule = (line) => is_row(line) && cells(line).every((cell) => /^:?-+:?$/.test(cell));
const cells = (line) => line.trim().slice(1, -1).split(/(?<!\\)\|/).map((cell) => cell.trim().replaceAll('\\|', '|'));

function table(lines, at) {
  const sides = cells(lines[at + 1]).map((rule) => (rule.endsWith(':') ? (rule.startsWith(':') ? 'center' : 'right') : 'left'));
  const cell_of = (tag) => (text, i) => element(tag, { style: `text-align: ${sides[i] ?? 'left'}` }, ...inline(text));
  const row = (line, tag) => element('tr', {}, ...cells(line).map(cell_of(tag)));
  let end = at + 2;
  while (is_row(lines[end])) ++end;
  const body = element('tbody', {}, ...lines.slice(at + 2, end).map((line) => row(line, 'td')));
  // Wide tables scroll by themselves, not the page.
  return [element('div', { className: 'wide', tabIndex: 0 }, element('table', {}, element('thead', {}, row(lines[at], 'th')), body)), end];
}

function list(lines, at) {
  const item = /^\s*([-*]|\d+\.)\s+(.*)$/;
  const made = element(/^\s*\d/.test(lines[at]) ? 'ol' : 'ul');
  let end = at;
  let words = [];
  const flush = () => words.length > 0 && made.append(element('li', {}, ...inline(words.join(' '))));
  for (; end < lines.length && lines[end].trim() !== ''; ++end) {
    const found = lines[end].match(item);
    if (!found) words.push(lines[end].trim());
    else flush(), (words = [found[2]]);
  }
  flush();
  return [made, end];
}

function paragraph(lines, at) {
  let end = at + 1;
  while (end < lines.length && lines[end].trim() !== '' && !/^(\s*```|#{1,6}\s|\s*([-*]|1\.)\s)/.test(lines[end]) && !is_row(lines[end])) ++end;
  return [element('p', {}, ...inline(lines.slice(at, end).join(' '))), end];
}

/** `code`, **strong**, and the text of [links](elsewhere). */
function inline(text) {
  return text.split(/(`[^`]+`|\*\*[^*]+\*\*|\[[^\]]+\]\([^)\s]+\))/).filter(Boolean).map((part) => {
    if (/^`.+`$/.test(part)) return element('code', { textContent: part.slice(1, -1) });
    if (/^\*\*.+\*\*$/.test(part)) return element('strong', {}, ...inline(part.slice(2, -2)));
    const link = part.match(/^\[([^\]]+)\]\(([^)\s]+)\)$/);
    if (!link) return part;
    if (!/^https?:\/\//.test(link[2])) return link[1];  // Relative links would not work from the page.
    return element('a', { href: link[2], rel: 'noreferrer', textContent: link[1] });
  });
}
