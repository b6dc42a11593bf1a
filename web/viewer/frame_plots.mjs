// SPDX-License-Identifier: GPL-3.0-or-later
// Specifications of the plots over frames, made for every run.
import { stage_names } from './numbers.mjs';
import { misses_nothing } from './outcome.mjs';

/**
 * @param {import('./container.mjs').Page} page
 * @param {(frame: number) => number} scene_frame
 * @returns {{name: string, title: string, description: string, spec: object}[]}
 */
export function frame_plots(page, scene_frame) {
  if (!page.stages || page.header.frames < 2) return [];
  const plots = [time_plot, distance_plot, ...(misses_nothing(page) ? [] : [recall_plot])];
  return plots.map((plot) => plot(page.stages, scene_frame, page.header.frame_step > 1)).filter(Boolean);
}

const x = {
  field: 'frame', type: 'quantitative', title: 'frame',
  scale: { nice: false, zero: false }, axis: { grid: false, tickCount: 8, tickMinStep: 1, format: 'd' },
};
const y = (field, scale) => ({ field, type: 'quantitative', title: null, scale });
const line = (interpolate) => ({ type: 'line', interpolate, strokeWidth: 1.5, tooltip: null, clip: true });

function time_plot(stages, scene_frame) {
  const used = Object.keys(stage_names).filter((key) => stages.some(({ microseconds }) => microseconds[key] > 0));
  if (used.length === 0) return undefined;
  const values = stages.flatMap(({ microseconds }, i) =>
    used.map((key) => ({ frame: scene_frame(i), stage: stage_names[key], us: microseconds[key] ?? 0 })));
  const names = used.map((key) => stage_names[key]);
  return {
    name: 'time',
    title: 'Time per stage',
    description: 'Microseconds in each frame. Below 1 the axis is linear, above it is logarithmic.',
    spec: {
      data: { values },
      mark: line('step'),
      encoding: {
        x,
        y: { ...y('us', { type: 'symlog', constant: 1, domainMin: 0 }), axis: { values: [0, 1, 10, 100, 1000, 1e4, 1e5, 1e6], format: ',d' } },
        color: { field: 'stage', sort: null, scale: { domain: names }, legend: { title: null, orient: 'bottom', columns: 3 } },
      },
    },
  };
}

function distance_plot(stages, scene_frame) {
  const values = stages.map(({ nearest }, i) => ({ frame: scene_frame(i), nearest })).filter(({ nearest }) => Number.isFinite(nearest));
  if (values.length === 0) return undefined;
  const always_meet = values.every(({ nearest }) => nearest === 0);
  return {
    name: 'distance',
    title: 'Distance of the nearest pair',
    description: 'Between the two objects nearest to each other, in units of the scene; 0 where surfaces meet.',
    spec: { data: { values }, mark: line('linear'), encoding: { x, y: y('nearest', { domainMin: 0, ...(always_meet ? { domainMax: 1 } : {}) }) } },
  };
}

/** No recall before the first collision. */
function recall_plot(stages, scene_frame, is_sample) {
  let positive = 0, found = 0;
  const values = [];
  stages.forEach((stage, i) => {
    positive += stage.positive ? 1 : 0;
    found += stage.positive && stage.found ? 1 : 0;
    if (positive > 0) values.push({ frame: scene_frame(i), recall: found / positive });
  });
  if (values.length === 0) return undefined;
  const domain = [scene_frame(0), scene_frame(stages.length - 1)];
  return {
    name: 'recall',
    title: 'Recall so far',
    description: `Of the frames${is_sample ? ' shown' : ''} with a collision up to here, the share in which it was found.`,
    spec: {
      data: { values },
      mark: line('step-after'),
      encoding: { x: { ...x, scale: { ...x.scale, domain } }, y: y('recall', { domain: [0, 1] }) },
    },
  };
}
