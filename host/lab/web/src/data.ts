/** The data of the page, as host/lab/page has written it into the file. */
import {bytesOfBase64, decodeColumns, GrowingColumn, inflated, type ColumnInfo} from './columns.ts';
import {Film, MapFilm, type MapInfo} from './film.ts';
import type {MapSeen} from './map_scenery.ts';

export type Point = [x: number, y: number];

export interface Mover {
  center: Point;
  radius: number;
  path: Point[];
  speed: number;
}

export interface World {
  start: Point;
  goal: Point;
  tolerance: number;
  bounds: [number, number, number, number] | null;
  discs: [x: number, y: number, radius: number][];
  polygons: Point[][];
  walls: Point[][];
  movers: Mover[];
}

/** Metres, radians, seconds. */
export interface RobotInfo {
  radius: number;
  track: number;
  max_speed: number;
  side_angle: number;
  cone: number;
  min_range: number;
  max_range: number;
  offset: number;
  cell: number;
  base_turn: number;
  period: number;
}

export interface Result {
  outcome: string;
  time_s: number;
  path_m: number;
  /** Null: the true place is not known. */
  final_distance_m: number | null;
  /** Null: the estimate of the robot is not known. */
  believed_distance_m: number | null;
  min_clearance_m: number;
  ticks: number;
  hash: string;
  detail: string;
  /** Unreachable: the verdict holds only if all gaps are narrower. */
  unreachable_above_m?: number;
  /** Of a drive of the guard: times that it brought the asked forward speed to nothing. */
  stops?: number;
  /** Of a drive of the guard: mean granted share of the asked forward speed. */
  granted?: number;
}

/** Of a drive of the guard: how it was set up. */
export interface GuardInfo {
  /** False: the wheels do what is asked. */
  guarded: boolean;
  /** Who commands, in words. */
  operator: string;
  nods: boolean;
  assist: boolean;
  vouched_m: number;
  command_timeout_s: number;
  /** Where the estimate of the guard begins at zero: x, y, heading. */
  put_down: [x: number, y: number, heading: number];
  /** Names of its reasons. */
  reasons: string[];
}

/** A followed boundary: from the hit to the leave. */
export interface Edge {
  hit: number;
  turned: number | null;
  left: number | null;
  end: 'none' | 'left' | 'wall_lost' | 'unreachable';
}

/** A run before its first tick. */
export interface Setting {
  name: string;
  /** Null: it is not known. */
  planner: string | null;
  /** The map of the planner; null: it has none, or it is not known. */
  map: MapInfo | null;
  /** False: the inputs of the table, the estimate and the counters of the core are not known. */
  inside: boolean;
  seed: number;
  time_limit: number;
  world: World;
  robot: RobotInfo;
  noise: Record<string, number>;
}

export interface RunInfo extends Setting {
  /** Null: the run is live, or its end is not known. */
  result: Result | null;
  edges: Edge[];
  /** A drive of the guard instead of a mission. */
  guard?: GuardInfo;
  columns: ColumnInfo[];
  /** Coarse: some ticks a second only. */
  detail?: 'full' | 'coarse';
  row?: number;
  command?: string;
}

export interface Variable {
  symbol: string;
  meaning: string;
  min: number;
  max: number;
  terms: [name: string, centre: number][];
}

export interface Controller {
  d: Variable;
  r: Variable;
  sa: Variable;
  sd: Variable;
  turn: [term: string, value: number][][];
  step: [term: string, value: number][][];
  samples_per_unit: number;
  sa_thousandths: number[];
  sd_thousandths: number[];
  d_nodes: number[];
  r_nodes: number[];
  source: string;
}

export interface Shared {
  modes: string[];
  whys: string[];
  faults: string[];
  /** Names of what leads the map planner; empty without a map. */
  guides: string[];
  doings: {name: string; label: string}[];
  /** A drive of the guard has none. */
  controller?: Controller;
}

export interface Estimate {
  value: number;
  low: number | null;
  high: number | null;
}

export interface CampaignInfo {
  summary: Record<string, unknown>;
  fields: string[];
  rows: (string | number | boolean | null)[][];
  /** Of the rows: the worst first. */
  order: number[];
  /** Row by row: what drives the mission again; null where the page can replay it. */
  commands: (string | null)[];
}

export interface PageData {
  format: number;
  shared: Shared;
  runs: RunInfo[];
  /** The address of the events of a live run. */
  live?: string;
  campaign?: CampaignInfo;
}

/** A reading as hal::RangeStatus numbers it. */
export const enum RangeStatus {
  ok,
  clear,
  tooNear,
  invalid,
  stale,
}

export const BEAMS = ['left', 'front', 'right'] as const;

export const COUNTERS = [
  'range_refused',
  'range_invalid',
  'range_stale',
  'range_stuck',
  'range_out_of_range',
  'drive_refused',
  'encoder_refused',
  'encoder_jumps',
  'wheel_stalls',
  'unsteady_looks',
  'no_progress',
  'pose_out_of_range',
  'wheel_runaways',
  'late_ticks',
  'clock_jumps',
  'bumps',
  'bumper_refused',
  'bumper_stuck',
] as const;

/** The data of a robot at a tick, of a run that is over or of a live one. */
export interface Seen {
  readonly info: {readonly world: World; readonly robot: RobotInfo; readonly inside: boolean};
  readonly t: ArrayLike<number>;
  /** The clear cells. `seek` returns the tick of the last picture at or before a tick, or -1. */
  readonly film: {
    seek(tick: number): number;
    forEachClear(bodyX: number, bodyY: number, clear: (x: number, y: number) => void): void;
  };
  /** Null: there is none, or it is not known. */
  readonly map: MapSeen | null;
  /** The robot reports the goal as reached, but is not there. */
  readonly offGoal: boolean;
  column(name: string): ArrayLike<number>;
  mode(tick: number): string;
  /** What leads the map planner. */
  guide(tick: number): string;
  why(tick: number): string;
  range(beam: number, tick: number): number | null;
}

/** As the trace has it: clear counts as the maximum range, too near as the minimum; null is lost. */
export function rangeOf(seen: Seen, beam: number, tick: number): number | null {
  switch (seen.column(`${BEAMS[beam]}_status`)[tick] as RangeStatus) {
    case RangeStatus.ok:
      return seen.column(`${BEAMS[beam]}_m`)[tick];
    case RangeStatus.clear:
      return seen.info.robot.max_range;
    case RangeStatus.tooNear:
      return seen.info.robot.min_range;
    default:
      return null;
  }
}

/** Forwards, m/s. */
export function speedOf(seen: Seen, tick: number): number {
  return (seen.column('v_left_mps')[tick] + seen.column('v_right_mps')[tick]) / 2;
}

/** The estimated and the true pose of the robot, and its pose in the frame of the local grid. */
const BELIEFS = [
  ['est_x_m', 'x_m', 'grid_x_m'],
  ['est_y_m', 'y_m', 'grid_y_m'],
  ['est_heading_rad', 'heading_rad', 'grid_heading_rad'],
] as const;

/** One run with all its ticks; a live run with all ticks so far. */
export class Run implements Seen {
  readonly film = new Film();
  readonly map: MapFilm | null;
  private readonly growing = new Map<string, GrowingColumn>();
  private readonly columns = new Map<string, Float64Array>();

  constructor(
    readonly info: RunInfo,
    readonly shared: Shared,
    columns: Map<string, Float64Array>,
  ) {
    // The first word is empty: the planner does not report it.
    const tells = columns.get('guide')?.[0] !== 0;
    this.map = info.map && info.inside && tells ? new MapFilm(info.map) : null;
    this.grow(columns, 0);
  }

  get ticks(): number {
    return this.t.length;
  }
  get t(): Float64Array {
    return this.column('t_s');
  }

  /** Adds ticks. `from` is the number of the first one: the next number, or 0 to replace all ticks. */
  grow(columns: Map<string, Float64Array>, from: number): void {
    for (const [name, values] of columns) {
      const column = from > 0 && this.growing.get(name);
      if (column) this.columns.set(name, column.append(values));
      else {
        this.growing.set(name, new GrowingColumn(values));
        this.columns.set(name, values);
      }
    }
    for (const [belief, , grid] of BELIEFS) this.columns.set(grid, this.column(belief));
    if (!this.info.inside) {
      for (const [belief, truth] of BELIEFS) this.columns.set(belief, this.column(truth));
    } else if (this.info.guard) {
      this.placeEstimate(this.info.guard.put_down);
    }
    const all = (name: string) =>
      [this.column(`${name}_tick`), this.column(`${name}_changes`), this.column(`${name}_word`), this.column(`${name}_bits`)] as const; // prettier-ignore
    this.film.grow(...all('film'));
    this.map?.grow(...all('map'));
    this.map?.growWindows(this.column('map_x'), this.column('map_y'));
  }

  /** The estimate of the guard begins at zero; the page needs it in the world. */
  private placeEstimate([x, y, heading]: GuardInfo['put_down']): void {
    const [ahead, aside, turned] = BELIEFS.map(([, , grid]) => this.column(grid));
    const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
    this.columns.set('est_x_m', ahead.map((dx, i) => x + cos * dx - sin * aside[i])); // prettier-ignore
    this.columns.set('est_y_m', ahead.map((dx, i) => y + sin * dx + cos * aside[i])); // prettier-ignore
    this.columns.set('est_heading_rad', turned.map((angle) => angle + heading)); // prettier-ignore
  }

  get offGoal(): boolean {
    return this.info.result?.outcome === 'off_goal';
  }

  /** The clear ground is known. */
  get hasFilm(): boolean {
    return this.film.ticks.length > 0;
  }

  column(name: string): Float64Array {
    const column = this.columns.get(name);
    if (!column) throw new Error(`no column ${name}`);
    return column;
  }

  mode(tick: number): string {
    return this.shared.modes[this.column('state')[tick]];
  }
  why(tick: number): string {
    return this.shared.whys[this.column('why')[tick]];
  }

  guide(tick: number): string {
    return this.shared.guides[this.column('guide')[tick]];
  }

  range(beam: number, tick: number): number | null {
    return rangeOf(this, beam, tick);
  }

  /** The tick with the nearest time. */
  tickAt(time: number): number {
    let low = 0;
    let high = this.ticks - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.t[middle] < time) low = middle + 1;
      else high = middle;
    }
    return low > 0 && time - this.t[low - 1] <= this.t[low] - time ? low - 1 : low;
  }
}

function textOf(id: string): string {
  const text = document.getElementById(id)?.textContent;
  if (!text) throw new Error('this page has no data: it is a template that whisker fills');
  return text;
}

export function pageData(): PageData {
  return JSON.parse(textOf('data')) as PageData;
}

export async function loadRun(data: PageData, index: number): Promise<Run> {
  const bytes = await inflated(bytesOfBase64(textOf(`columns-${index}`)));
  const info = data.runs[index];
  return new Run(info, data.shared, decodeColumns(bytes, info.columns));
}
