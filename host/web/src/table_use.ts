import type {Seen} from './data.ts';

const STEERED = new Set(['going', 'steering', 'stepping']);

/** True where the response table bends the course at this tick; elsewhere its answer is an old one. */
export function usesTable(run: Seen, tick: number): boolean {
  return STEERED.has(run.mode(tick));
}
