/** A mission of a campaign. */
import type {Ended} from './words.ts';

export interface Mission extends Ended {
  seed: number;
  success: boolean;
  time_s: number;
  path_m: number;
  shortest_m: number | null;
  ratio: number | null;
  s_per_m: number | null;
  clearance: number;
  estimate_error: number;
  detail: string;
}

/** Its verdict is correct and true. */
export function isGood({success, outcome}: Mission): boolean {
  return success && outcome !== 'off_goal';
}
