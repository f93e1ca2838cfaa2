/** A robot of the playground, for the parts of the replay page: a run of which only the current tick is known. */
import {rangeOf, type Seen} from '../data.ts';
import type {CommandArcs} from '../command_arcs.ts';
import type {WayLooks} from '../story.ts';
import {DOING_COLOURS, DOING_WIDTHS} from '../way_looks.ts';
import type {Core, Result} from './core.ts';
import {LiveMap} from './live_map.ts';
import type {Situation} from './situation.ts';
import type {Ended} from '../words.ts';

/** A piece of the path in one class. */
export interface Stretch {
  kind: number;
  path: Path2D;
}

/** Colours and widths of the classes of the path. */
export type Looks = Omit<WayLooks, 'column'>;

/** What a run needs of the core that drives it. */
export type Driven = Pick<
  Core,
  | 'words'
  | 'robot'
  | 'begin'
  | 'change'
  | 'advance'
  | 'record'
  | 'result'
  | 'way'
  | 'clearCells'
  | 'mapBytes'
  | 'map'
>;

export class LiveRun<C extends Driven = Driven> implements Seen {
  /** The only tick. */
  readonly tick = 0;
  info: Seen['info'];
  result: Result;
  stretches: Stretch[] = [];
  /** Null: the planner has none. */
  readonly map: LiveMap | null;
  private readonly columns = new Map<string, Float64Array>();
  private cells: Float64Array = new Float64Array();
  private passed = 0;
  private last: [x: number, y: number] = [0, 0];
  /** The least true distance to the goal so far, m. */
  nearest = Infinity;

  constructor(
    protected readonly core: C,
    protected readonly side: number,
    readonly planner: string,
    situation: Situation,
    begin = () => core.begin(side, planner, situation),
  ) {
    begin();
    this.info = this.infoOf(situation);
    const bytes = core.mapBytes(side);
    this.map = bytes > 0 ? new LiveMap(bytes) : null;
    this.result = core.result(side);
    this.refresh();
  }

  get looks(): Looks {
    return {colours: DOING_COLOURS, widths: DOING_WIDTHS};
  }

  /** What is asked for and granted; null: a planner drives. */
  get arcs(): CommandArcs | null {
    return null;
  }

  /** Why the planner does not get stuck, or when it does. */
  get about(): string {
    const {planners, abouts} = this.core.words;
    return abouts[planners.indexOf(this.planner)];
  }

  get offGoal(): boolean {
    return this.result.outcome === 'off_goal';
  }

  /** Null: the run has not ended. */
  get ended(): Ended | null {
    const {outcome, distance} = this.result;
    return outcome && {outcome, final_distance_m: distance};
  }

  get over(): boolean {
    return this.result.outcome !== null;
  }

  advance(ticks: number): void {
    if (this.over) return;
    this.core.advance(this.side, ticks);
    this.result = this.core.result(this.side);
  }

  /** It cannot follow yet. */
  get waits(): boolean {
    return false;
  }

  change(situation: Situation): void {
    const [x, y] = situation.world.goal;
    if (x !== this.info.world.goal[0] || y !== this.info.world.goal[1]) this.nearest = Infinity;
    this.core.change(this.side, situation);
    this.info = this.infoOf(situation);
    this.refresh();
  }

  /** Reads the current state from the core. */
  refresh(): void {
    this.core.record(this.side, this.columns);
    this.result = this.core.result(this.side);
    this.cells = this.core.clearCells(this.side);
    this.map?.show(this.core.map(this.side));
    const way = this.core.way(this.side, this.passed);
    for (let i = 0; i < way.length; i += 3) this.pass(way[i], way[i + 1], way[i + 2]);
    this.passed += way.length / 3;
    this.nearest = Math.min(this.nearest, this.distance);
  }

  /** True, m. */
  get distance(): number {
    return this.away(this.column('x_m')[0], this.column('y_m')[0]);
  }

  get t(): Float64Array {
    return this.column('t_s');
  }
  column(name: string): Float64Array {
    return this.columns.get(name)!;
  }
  mode(): string {
    return this.core.words.modes[this.column('state')[0]];
  }
  why(): string {
    return this.core.words.whys[this.column('why')[0]];
  }
  fault(): string {
    return this.core.words.faults[this.column('fault')[0]];
  }
  guide(): string {
    return this.core.words.guides[this.column('guide')[0]];
  }
  range(beam: number, tick: number): number | null {
    return rangeOf(this, beam, tick);
  }

  readonly film = {
    seek: () => 0,
    forEachClear: (_x: number, _y: number, clear: (x: number, y: number) => void) => {
      for (let i = 0; i < this.cells.length; i += 2) clear(this.cells[i], this.cells[i + 1]);
    },
  };

  /** The guard alone does not report what its response table is asked. */
  private infoOf({world}: Situation): Seen['info'] {
    const {robot, words} = this.core;
    return {world, robot, inside: words.planners.includes(this.planner)};
  }

  private away(x: number, y: number): number {
    const {goal} = this.info.world;
    return Math.hypot(goal[0] - x, goal[1] - y);
  }

  private pass(x: number, y: number, kind: number): void {
    this.nearest = Math.min(this.nearest, this.away(x, y));
    let stretch = this.stretches.at(-1);
    if (!stretch || stretch.kind !== kind) {
      stretch = {kind, path: new Path2D()};
      stretch.path.moveTo(...(this.stretches.length > 0 ? this.last : ([x, y] as [number, number])));
      this.stretches.push(stretch);
    }
    stretch.path.lineTo(x, y);
    this.last = [x, y];
  }
}
