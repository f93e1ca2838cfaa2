/** A drive of the guard: what the operator asked, what was granted, and why. */
import {ChartLane} from './chart_lane.ts';
import type {Result, Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {Grants} from './grants.ts';
import {BARE, REASONS, shareWords, velocityWords} from './guard_words.ts';
import {BlockLane, type Lane} from './lanes.ts';
import {noiseWords, sharedFacts} from './run_facts.ts';
import {showPartsOf, type Story, type WayLooks} from './story.ts';
import type {Colour} from './theme.ts';
import {metres, shownName} from './words.ts';

const ENDS: Record<string, [words: string, outcome: string]> = {
  reached: ['arrived at the goal', 'reached'],
  contact: ['touched an obstacle', 'contact'],
  fault: ['stopped with a fault', 'fault'],
  gave_up: ['out of time', 'none'],
  ended: ['ended by the operator', 'none'],
};

const WITH = 'the guard keeps it off obstacles';
const WITHOUT = 'no guard holds it back';

const yes = (on: boolean) => (on ? 'on' : 'off');

export class GuardStory implements Story {
  readonly lanes: Lane[];
  readonly way: WayLooks;

  constructor(
    private readonly run: Run,
    private readonly grants: Grants,
  ) {
    this.lanes = [
      new BlockLane('why', run, (tick) => this.chip(tick)),
      new ChartLane('speed', grants, 'forward'),
      new ChartLane('turning', grants, 'turning'),
    ];
    const {guarded, reasons} = grants.info;
    const colours = reasons.map((reason) => (guarded ? REASONS[reason] : BARE).colour);
    this.way = {column: 'reason', colours, widths: colours.map((colour) => (colour === 'free' ? 2.5 : 3.5))};
  }

  open(): void {
    const {guarded, operator, reasons} = this.grants.info;
    showPartsOf('guard');
    element('clear-unknown').hidden = true;
    element('granted-key').hidden = !guarded;
    element('panel-reasons').hidden = !guarded;
    setText('planner-name', `${operator}, guard ${yes(guarded)}`);
    setText(
      'what',
      `An operator commands a small robot with three rangefinders; ${guarded ? WITH : WITHOUT}.`,
    );
    if (!guarded) return;
    const came = new Set(this.run.column('reason'));
    const keys = reasons.map((reason, i) => {
      const key = make('span', 'key block');
      key.style.setProperty('--key', `var(--${REASONS[reason].colour})`);
      const item = make('li', '', [key, document.createTextNode(shownName(reason))]);
      item.hidden = !came.has(i);
      return item;
    });
    element('clear-key').before(...keys);
  }

  chip(tick: number): [words: string, colour: Colour] {
    return [shownName(this.grants.reason(tick)), this.grants.colour(tick)];
  }

  sentence(tick: number): string {
    const {grants} = this;
    const asked = grants.at(grants.asked, tick);
    const share = grants.info.guarded && shareWords(asked, grants.at(grants.share, tick));
    return `Asked: ${velocityWords(asked)}.${share ? ` Granted: ${share}.` : ''} ${grants.says(tick)}`;
  }

  verdict({outcome, time_s}: Result): [words: string, outcome: string] {
    const [words, kind] = ENDS[outcome] ?? [outcome, 'none'];
    return [`${words} after ${time_s.toFixed(1)} s`, kind];
  }

  facts(result: Result | null): [term: string, value: string][] {
    const {info} = this.grants;
    const facts: [string, string][] = [
      ['operator', info.operator],
      ['guard', yes(info.guarded)],
    ];
    if (info.guarded) {
      facts.push(
        ['nods', yes(info.nods)],
        ['assist', yes(info.assist)],
        ['vouched for', info.vouched_m > 0 ? `${metres(info.vouched_m)} around the start` : 'nothing'],
        ['a command holds for', `${info.command_timeout_s} s`],
      );
    }
    facts.push(['noise', noiseWords(this.run.info.noise)], ['seed', String(this.run.info.seed)]);
    if (!result) return facts;
    facts.unshift(...sharedFacts(result), ['from the goal at the end', metres(result.final_distance_m ?? 0)]);
    facts.push(['ticks', String(result.ticks)]);
    if (info.guarded) facts.push(['command hash', result.hash]);
    return facts;
  }
}
