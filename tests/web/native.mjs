// Hashes of native runs, by world class, seed and planner.
import {Folder, whisker} from './scenarios.mjs';

export const KINDS = ['discs', 'poles', 'u-trap', 'spiral', 'maze', 'rooms', 'enclosed'];
const SEEDS = [1, 2, 3, 7];

export function nativeHashes() {
  const folder = new Folder();
  const hashes = {};
  try {
    for (const kind of KINDS) {
      for (const seed of SEEDS) {
        const scenario = folder.at('world.toml');
        whisker('world', kind, '--seed', seed, '--out', scenario);
        for (const planner of ['skirt', 'thesis']) {
          const result = JSON.parse(whisker('run', scenario, '--planner', planner, '--json'));
          hashes[`${kind} ${seed} ${planner}`] = result.hash;
        }
      }
    }
  } finally {
    folder.remove();
  }
  return hashes;
}
