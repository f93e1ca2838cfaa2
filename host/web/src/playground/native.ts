/** The hashes of native runs, recorded by host/web/native.mjs, and what to say where none is known. */
import type {HashNote} from './cards.ts';
import recorded from './native.json';
import type {Playground} from './playground.ts';

const HASHES: Record<string, string> = recorded;

export function notesOf({runs, state, touched}: Playground): HashNote[] {
  const plain = !state.own && !state.rules && state.noise.every((x) => x === 0);
  return runs.map(({planner, over}) => {
    const native = (plain && HASHES[`${state.kind} ${state.seed} ${planner}`]) || null;
    if (touched) return {native: null, words: 'changed under way: drive again from the start to compare'};
    if (!over) return {native, words: 'of the drive so far'};
    if (state.rules) return {native, words: 'with your rules: build with the table to compare'};
    return {native, words: 'compare: save the scenario and run it'};
  });
}
