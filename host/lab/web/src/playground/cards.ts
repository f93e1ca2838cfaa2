/** What each robot does now, in words, and its verdict. */
import {element, make, setText} from '../dom.ts';
import {speedOf} from '../data.ts';
import type {Theme} from '../theme.ts';
import {stateColour} from '../mission_story.ts';
import {FAULTS, metres, sentence, shownName, verdict, verdictClass} from '../words.ts';
import {GuardRun} from './guard_run.ts';
import type {LiveRun} from './live.ts';
import {PicoRun} from './pico.ts';

export function showCard(card: HTMLElement, run: LiveRun, theme: Theme): void {
  const part = (name: string) => card.querySelector<HTMLElement>(`[data-part=${name}]`)!;
  const say = (name: string, text: string) => {
    if (part(name).textContent !== text) part(name).textContent = text;
  };
  const {time, way} = run.result;
  const {ended} = run;
  const yours = run instanceof GuardRun;
  const chip = run instanceof PicoRun;
  say('planner', yours ? 'you drive' : chip ? 'a Pico drives' : `${shownName(run.planner)} planner`);
  say('state', shownName(yours ? run.reason : run.mode()));
  const colour = yours ? run.colour : stateColour(run, 0);
  part('state').style.setProperty('--chip', theme.palette[colour]);
  part('state').classList.toggle('pale', colour === 'still');
  const fault = run.fault();
  say(
    'sentence',
    ((yours || chip ? run.sentence : '') || sentence(run.mode(), run.why(), run.guide(), speedOf(run, 0))) +
      (fault === 'none' ? '' : ` The fault: ${FAULTS[fault]}.`),
  );
  say('verdict', ended ? verdict(ended, time) : '');
  part('verdict').dataset.outcome = ended ? verdictClass(ended) : '';
  say('clock', `${time.toFixed(1)} s, ${metres(way, 1)}`);
}

/** Shows the progress of the robot that the panels show. */
export function showProgress(run: LiveRun, several: boolean): void {
  setText('progress', run.about ?? '');
  setText('to-goal', metres(run.distance));
  setText('nearest', metres(run.nearest));
  for (const whose of document.querySelectorAll('.whose')) {
    whose.textContent = several ? `(${shownName(run.planner)} planner)` : '';
  }
}

export interface HashNote {
  /** The hash of the native run, if it is recorded. */
  native: string | null;
  /** Shown instead of a comparison. */
  words: string;
}

export function showLedger(runs: LiveRun[], notes: HashNote[]): void {
  const rows = runs.map((run, i) => {
    const {hash, ticks, outcome} = run.result;
    const {native, words} = notes[i];
    const known = native !== null && outcome !== null;
    const equal = native === hash;
    const mark = make(
      'span',
      equal ? 'equal' : 'bad',
      equal ? 'equals the native run' : 'differs from the native run',
    );
    const row = make('div', '', [
      make('dt', '', shownName(run.planner)),
      make('dd', '', [
        make('code', '', hash),
        make('span', 'muted', ` ${ticks} ticks `),
        known ? mark : make('span', 'muted', words),
      ]),
    ]);
    row.dataset.planner = run.planner;
    return row;
  });
  element('hashes').replaceChildren(...rows);
}
