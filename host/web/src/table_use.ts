import type {Run} from './data.ts';

const STEERED = new Set(['going', 'steering', 'stepping']);

/** True where the response table bends the course at this tick; elsewhere its answer is an old one. */
export function usesTable(run: Run, tick: number): boolean {
  return STEERED.has(run.mode(tick));
}
