/** A mission: states and reasons of the planner, and its verdict. */
import {speedOf, type Result, type Run, type Seen} from './data.ts';
import {element, setText} from './dom.ts';
import {BlockLane, type Lane} from './lanes.ts';
import {showPathKeys} from './legend.ts';
import {noiseWords, sharedFacts} from './run_facts.ts';
import {showPartsOf, type Story} from './story.ts';
import {bendOf} from './table_use.ts';
import type {Colour} from './theme.ts';
import {DOING_COLOURS, DOING_WIDTHS} from './way_looks.ts';
import {metres, sentence, shownName, verdict, verdictClass} from './words.ts';

const STILL = new Set(['facing', 'looking', 'searching', 'surveying', 'idle']);
const OVER = new Set(['arrived', 'unreachable', 'gave_up', 'stopped']);

const WHY_COLOURS: Record<string, Colour> = {
  target_free: 'free',
  at_goal: 'goal',
  table: 'table',
  narrow: 'probing',
  target_blocked: 'danger',
  exit_left: 'danger',
  exit_right: 'danger',
  same_side: 'danger',
  edge: 'danger',
  opening: 'danger',
  way_back: 'danger',
  came_round: 'contact',
  wall_lost: 'contact',
  no_exit: 'contact',
  blind: 'contact',
  fault: 'contact',
  step_budget: 'contact',
  length_budget: 'contact',
  goal_out_of_range: 'contact',
  tolerance_too_small: 'contact',
  bumped: 'contact',
};

const GUIDES: Record<string, [label: string, colour: Colour]> = {
  goal: ['straight', 'free'],
  place: ['way point', 'map'],
  wait: ['plans', 'still'],
  none: ['boundary', 'danger'],
};

export function stateColour(run: Seen, tick: number): Colour {
  const mode = run.mode(tick);
  if (OVER.has(mode)) return mode === 'arrived' && !run.offGoal ? 'goal' : 'over';
  if (STILL.has(mode)) return 'still';
  return (['free', 'table', 'probing', 'danger'] as const)[run.column('doing')[tick]];
}

/** "map planner, 2048 bytes"; empty if the planner is not known. */
function plannerWords({planner, map}: Run['info']): string {
  if (map) return `map planner, ${map.bytes} bytes`;
  return planner ? `${shownName(planner)} planner` : '';
}

function andMap({planner, map}: Run['info']): string {
  if (map) return ` and a map of ${map.bytes} bytes`;
  return planner ? ' and no map' : '';
}

function orUnknown(distance: number | null): string {
  return distance === null ? 'not known here' : metres(distance, 3);
}

/** On a bus, part of the data stays in the controller. */
function sayWhatIsUnknown(run: Run): void {
  const {inside, map} = run.info;
  element('map-unknown').hidden = !map || run.map !== null;
  element('counters-unknown').hidden = inside;
  element('rules').hidden = !inside;
  element('clear-unknown').hidden = run.hasFilm;
}

export class MissionStory implements Story {
  readonly lanes: Lane[];
  private readonly state: BlockLane;
  private readonly map: BlockLane | null;
  private scanned = 0;
  private bends = false;
  readonly way = {column: 'doing', colours: DOING_COLOURS, widths: DOING_WIDTHS};

  constructor(private readonly run: Run) {
    this.state = new BlockLane('state', run, (tick) => this.chip(tick));
    this.map = run.map && new BlockLane('map', run, (tick) => this.guide(tick), false);
    this.lanes = [this.state, new BlockLane('why', run, (tick) => this.why(tick))];
    if (this.map) this.lanes.push(this.map);
  }

  open(): void {
    showPartsOf('mission');
    setText('planner-name', plannerWords(this.run.info));
    setText('and-map', andMap(this.run.info));
    sayWhatIsUnknown(this.run);
    this.grow();
  }

  /** Shows the keys of what has occurred. */
  grow(): void {
    const {run, state, map} = this;
    for (; this.scanned < run.ticks; ++this.scanned) this.bends ||= bendOf(run, this.scanned) !== 0;
    state.grow();
    map?.grow();
    showPathKeys(state.colours());
    element('way-key').hidden = !map?.colours().has('map');
    element('course-key').hidden = !this.bends;
  }

  chip(tick: number): [words: string, colour: Colour] {
    return [shownName(this.run.mode(tick)), stateColour(this.run, tick)];
  }

  sentence(tick: number): string {
    const {run} = this;
    return sentence(run.mode(tick), run.why(tick), run.guide(tick), speedOf(run, tick));
  }

  verdict(result: Result): [words: string, outcome: string] {
    return [verdict(result, result.time_s), verdictClass(result)];
  }

  facts(result: Result | null): [term: string, value: string][] {
    const {info} = this.run;
    const facts: [string, string][] = [
      ['planner', info.map ? plannerWords(info) : shownName(info.planner ?? 'not known here')],
      ['noise', noiseWords(info.noise)],
      ['noise seed', String(info.seed)],
    ];
    if (!result) return facts;
    facts.unshift(
      ...sharedFacts(result),
      ['from the goal at the end', orUnknown(result.final_distance_m)],
      ['by its own estimate', orUnknown(result.believed_distance_m)],
    );
    if (result.unreachable_above_m !== undefined) {
      facts.unshift(['if all gaps are below', metres(result.unreachable_above_m, 3)]);
    }
    facts.push(
      ['ticks', String(result.ticks)],
      ['command hash', result.hash],
      ['detail', result.detail || '-'],
    );
    return facts;
  }

  private why(tick: number): [label: string, colour: Colour] {
    const why = this.run.why(tick);
    const colour = why === 'at_goal' && this.run.offGoal ? 'over' : (WHY_COLOURS[why] ?? 'still');
    return [shownName(why), colour];
  }

  /** What leads the map planner; empty before the first movement. */
  private guide(tick: number): [label: string, colour: Colour] {
    return this.run.why(tick) === 'goal_set' ? ['', 'still'] : GUIDES[this.run.guide(tick)];
  }
}
