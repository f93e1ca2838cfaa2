import type {Seen} from './data.ts';

const STEERED = new Set(['going', 'steering', 'stepping']);

/** True where it is known that the response table bends the course at this tick; elsewhere its answer is an old one. */
export function usesTable(run: Seen, tick: number): boolean {
  return run.info.inside && STEERED.has(run.mode(tick));
}
