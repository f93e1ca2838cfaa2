/** The hashes of native runs, recorded by host/lab/web/native.mjs, and the note for a run without one. */
import type {HashNote} from './cards.ts';
import recorded from './native.json';
import {YOU} from './driver.ts';
import {PicoRun} from './pico.ts';
import type {Playground} from './playground.ts';

const HASHES: Record<string, string> = recorded;

export function notesOf({runs, state, opened, touched}: Playground): HashNote[] {
  const plain = !state.own && !state.rules && !opened && state.noise.every((x) => x === 0);
  return runs.map((run) => {
    const {planner, over} = run;
    if (run instanceof PicoRun) return {native: null, words: run.compared};
    const native = (plain && HASHES[`${state.kind} ${state.seed} ${planner}`]) || null;
    if (touched) return {native: null, words: 'changed during the run: restart it to compare'};
    if (!over && planner !== YOU) return {native, words: 'of the run so far'};
    if (planner === YOU) return {native, words: 'compare: save scenario and drive, and run the command'};
    if (opened) return {native, words: 'compare: save the scenario and run it with --rules'};
    if (state.rules) return {native, words: 'with your rules: build whisker with the saved table to compare'};
    return {native, words: 'compare: save the scenario and run it'};
  });
}
