import {BEAMS, RangeStatus, type Seen} from './data.ts';

const STEERED = new Set(['steering', 'stepping']);

/** By how much SA bends the course at this tick, rad. */
export function bendOf(run: Seen, tick: number): number {
  if (!run.info.inside) return 0;
  if (STEERED.has(run.mode(tick))) return run.column('sa')[tick] * run.info.robot.base_turn;
  return run.column('bend_rad')[tick];
}

/** The speed straight ahead that SD sets at this tick, m/s; 0: it sets none. */
export function paceOf(run: Seen, tick: number): number {
  return run.info.inside ? run.column('pace_mps')[tick] : 0;
}

/** True if an answer of the response table is known to act at this tick. */
export function usesTable(run: Seen, tick: number): boolean {
  return bendOf(run, tick) !== 0 || paceOf(run, tick) > 0;
}

/** The ranges of D and R, and the largest difference by noise between an input and the readings of its tick. */
const MOST_D = 10;
const MOST_R = 8;
const ALIKE = 0.6;

/** False: the readings of this tick differ from the input of the table. The input is a consensus of several readings, and not of every tick. */
export function asksOfNow(run: Seen, tick: number): boolean {
  // The thesis planner asks of echoes, all others of the ground.
  if (!STEERED.has(run.mode(tick))) return true;
  const {max_range: most} = run.info.robot;
  const known = (beam: number) =>
    (run.column(`${BEAMS[beam]}_status`)[tick] as RangeStatus) < RangeStatus.invalid;
  const [left, front, right] = BEAMS.map((_, beam) => (known(beam) ? run.range(beam, tick) : null));
  const [d, r] = [run.column('d')[tick], run.column('r')[tick]];
  const alike = (asked: number, read: number) => Math.abs(asked - read) < ALIKE;
  if (left !== null && right !== null && !alike(r, (MOST_R * (right - left)) / most)) return false;
  return front === null || alike(d, (MOST_D * front) / most);
}
