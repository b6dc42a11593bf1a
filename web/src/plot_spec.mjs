// SPDX-License-Identifier: GPL-3.0-or-later
// Reads Vega-Lite specifications, puts their data into them, and checks that the fields they name exist.
import fs from 'node:fs';
import path from 'node:path';
import { codegenExpression, parseExpression, splitAccessPath } from 'vega';
import { Bad_input, read_json } from './command.mjs';

const extension = '.vl.json';

/**
 * @typedef {object} Plot
 * @property {string} name        of the file, without its extension
 * @property {string} title
 * @property {string} description
 * @property {object} spec        a Vega-Lite specification with inline data
 */

/**
 * All plots of a folder, in the order of their names.
 * @param {string} spec_folder  holds *.vl.json
 * @param {string} data_folder  folder that data paths are relative to
 * @returns {Plot[]}
 */
export function read_plots(spec_folder, data_folder) {
  const files = list_files(spec_folder).filter((file) => file.endsWith(extension)).sort();
  if (files.length === 0) throw new Bad_input(`${spec_folder}: holds no *${extension}`);
  return files.map((file) => read_plot(path.join(spec_folder, file), data_folder));
}

function list_files(folder) {
  try {
    return fs.readdirSync(folder);
  } catch {
    throw new Bad_input(`${folder}: no such folder`);
  }
}

function read_plot(file, data_folder) {
  const spec = read_json(file);
  if (!is_object(spec)) throw new Bad_input(`${file}: not a Vega-Lite specification, which is a JSON object`);
  const rows = inline_data(spec, file, data_folder);
  if (rows.length === 0) throw new Bad_input(`${file}: no data: expected "data": {"url": "FILE.json"}`);
  check_fields(spec, rows, file);
  const name = path.basename(file, extension);
  const title = spec.title?.text ?? spec.title ?? name.replaceAll('_', ' ');
  return { name, title: [title].flat().join(' '), description: spec.description ?? '', spec };
}

/** Replaces each `data` of a specification, at any depth, by its rows; returns all rows. */
function inline_data(spec, file, data_folder) {
  const all_rows = [];
  for (const node of objects_in(spec)) {
    if (!is_object(node.data)) continue;
    const rows = node.data.values ?? read_rows(node.data, file, data_folder);
    if (!Array.isArray(rows)) continue;
    node.data = { values: rows };
    all_rows.push(...rows);
  }
  return all_rows;
}

/** The rows a `data` refers to: `{"url": "FILE.json"}`, or `{"name": "table"}` for table.json. */
function read_rows(data, file, data_folder) {
  const url = data.url ?? (data.name && `${data.name}.json`);
  if (typeof url !== 'string') return undefined;
  if (/^\w+:|^\/|(^|\/)\.\.(\/|$)/.test(url)) throw new Bad_input(`${file}: data "${url}" is outside the results' folder`);
  const data_file = path.join(data_folder, url);
  if (!fs.existsSync(data_file)) throw new Bad_input(`${file}: its data ${data_file} does not exist`);
  const property = data.format?.property;
  const rows = splitAccessPath(property ?? '').reduce((value, key) => value?.[key], read_json(data_file));
  const place = property ? `${data_file}, property ${property}` : data_file;
  if (!Array.isArray(rows) || rows.length === 0 || !rows.every(is_object))
    throw new Bad_input(`${file}: its data ${place} is not a list of rows, [{"field": value, ...}, ...]`);
  return rows;
}

/** Checks that every field is in a row or computed, since Vega silently draws an empty plot for a misspelt field. */
function check_fields(spec, rows, file) {
  const nodes = [...objects_in(spec)];
  // The names of pivoted columns are data values.
  if (nodes.some((node) => node.pivot !== undefined)) return;
  const known = new Set([...rows.flatMap((row) => Object.keys(row)), ...nodes.flatMap(computed_fields)]);
  for (const field of nodes.flatMap(named_fields))
    if (!known.has(field) && !known.has(splitAccessPath(field)[0]))
      throw new Bad_input(`${file}: field "${field}" is in no row of its data`);
}

function computed_fields(node) {
  const fields = [node.as].flat();
  if (node.fold) fields.push('key', 'value');
  if (node.density) fields.push('value', 'density');
  if (node.quantile) fields.push('prob', 'value');
  if (node.params === true) fields.push('coef', 'rSquared');
  return fields;
}

function named_fields(node) {
  const fields = [node.field, node.lookup, node.groupby, node.fields, node.fold, node.flatten, node.density, node.quantile];
  if (typeof node.repeat === 'object') fields.push(...Object.values(node.repeat));
  for (const expression of [node.calculate, node.filter])
    if (typeof expression === 'string') fields.push(expression_fields(expression));
  return fields.flat().filter((field) => typeof field === 'string');
}

function expression_fields(expression) {
  const generate = codegenExpression({ fieldvar: 'datum', globalvar: 'event', allowed: ['datum'] });
  try {
    return generate(parseExpression(expression)).fields;
  } catch {
    return [];  // The compiler's message is better.
  }
}

/** Every object inside a specification, including itself but not its data rows. */
function* objects_in(node) {
  if (is_object(node)) yield node;
  for (const [key, child] of Object.entries(node ?? {}))
    if (key !== 'values' && typeof child === 'object') yield* objects_in(child);
}

function is_object(value) {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
