/** Facts that every kind of run has, in words. */
import type {Result} from './data.ts';
import {metres} from './words.ts';

const NOISE: [key: string, words: string, factor: number, unit: string][] = [
  ['range_sigma_m', 'range noise', 1000, 'mm'],
  ['range_dropout', 'readings lost', 100, '%'],
  ['range_false_clear', 'false clear', 100, '%'],
  ['wheel_scale_sigma', 'wheel scale error', 100, '%'],
  ['heading_drift_deg_per_sqrt_m', 'heading drift', 1, '°/√m'],
];

export function noiseWords(noise: Record<string, number>): string {
  const parts = NOISE.filter(([key]) => noise[key] > 0).map(
    ([key, words, factor, unit]) => `${words} ${Number((noise[key] * factor).toPrecision(3))} ${unit}`,
  );
  return parts.length > 0 ? parts.join(', ') : 'none';
}

/** The smallest gap between body and obstacle. */
export function clearanceWords({min_clearance_m}: Result): string {
  return min_clearance_m < 1000 ? metres(min_clearance_m, 3) : 'no obstacle near';
}

export function sharedFacts(result: Result): [term: string, value: string][] {
  return [
    ['path driven', metres(result.path_m)],
    ['nearest to an obstacle', clearanceWords(result)],
  ];
}
