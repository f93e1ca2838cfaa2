// Hashes of native runs.
import {Folder, whisker} from './scenarios.mjs';

export const KINDS = ['discs', 'poles', 'u-trap', 'spiral', 'maze', 'rooms', 'enclosed'];
const SEEDS = [1, 2, 3, 7];

/** By "class seed planner". */
export function nativeHashes(seeds = SEEDS, planners = ['skirt', 'thesis', 'map']) {
  const folder = new Folder();
  const hashes = {};
  try {
    for (const kind of KINDS) {
      for (const seed of seeds) {
        const scenario = folder.at('world.toml');
        whisker('world', kind, '--seed', seed, '--out', scenario);
        for (const planner of planners) {
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
