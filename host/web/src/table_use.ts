import {BEAMS, RangeStatus, type Seen} from './data.ts';

const STEERED = new Set(['going', 'steering', 'stepping']);

/** True where it is known that the response table bends the course at this tick; elsewhere its answer is an old one. */
export function usesTable(run: Seen, tick: number): boolean {
  return run.info.inside && STEERED.has(run.mode(tick));
}

/** D and R in their own units; between the question and the readings of its tick, noise may be as much. */
const MOST_D = 10;
const MOST_R = 8;
const ALIKE = 0.6;

/** False: the beams read otherwise at this tick. The table is asked with what several readings agree on, and not at every tick. */
export function asksOfNow(run: Seen, tick: number): boolean {
  const {max_range: most} = run.info.robot;
  const known = (beam: number) =>
    (run.column(`${BEAMS[beam]}_status`)[tick] as RangeStatus) < RangeStatus.invalid;
  const [left, front, right] = BEAMS.map((_, beam) => (known(beam) ? run.range(beam, tick) : null));
  const [d, r] = [run.column('d')[tick], run.column('r')[tick]];
  const alike = (asked: number, read: number) => Math.abs(asked - read) < ALIKE;
  if (left !== null && right !== null && !alike(r, (MOST_R * (right - left)) / most)) return false;
  if (front === null || alike(d, (MOST_D * front) / most)) return true;
  // A robot may be told to take the mean of the three.
  return left !== null && right !== null && alike(d, (MOST_D * (left + front + right)) / 3 / most);
}
