/** The core, the simulator and the worlds, as host/lab/play/exports.cpp exports them. */
import type {RobotInfo} from '../data.ts';
import type {Switches} from './driver.ts';
import type {Grant} from './guard_run.ts';
import {flat, situationOf, type Situation} from './situation.ts';

interface Exports {
  memory: WebAssembly.Memory;
  _initialize(): void;
  list(count: number): number;
  generate(kind: number, seed: number, discs: number, box: number, noise: number): number;
  judge(): number;
  begin(side: number, planner: number): number;
  begin_guard(guarded: number, nods: number, assist: number): number;
  set_guard(guarded: number, nods: number, assist: number): void;
  command(forward: number, turning: number): void;
  grant(): number;
  change(side: number): number;
  advance(side: number, ticks: number): void;
  record(side: number): number;
  result(side: number): number;
  way(side: number, from: number): number;
  clear_cells(side: number): number;
  map_bytes(side: number): number;
  map(side: number): number;
  robot(side: number): number;
  get_rules(): number;
  set_rules(): number;
  set_table(hash: number): number;
  at_fault(d: number, r: number): number;
  get_table(): number;
  sample_table(): number;
  word(which: number, i: number): number;
}

/** The columns that record() returns, in its order. */
const COLUMNS = [
  't_s', 'x_m', 'y_m', 'heading_rad', 'est_x_m', 'est_y_m', 'est_heading_rad', 'v_left_mps', 'v_right_mps',
  'state', 'why', 'doing', 't', 'd', 'r', 'sa', 'sd', 'cell_d', 'cell_r', 'fault',
  'guide', 'way_x_m', 'way_y_m', 'sigma_along_m', 'sigma_across_m', 'sigma_heading_rad',
  'grid_x_m', 'grid_y_m', 'grid_heading_rad',
  'left_m', 'left_status', 'front_m', 'front_status', 'right_m', 'right_status',
  'bend_rad', 'pace_mps',
] as const; // prettier-ignore

export const OUTCOMES = ['reached', 'off_goal', 'unreachable', 'gave_up', 'contact', 'fault'] as const;

export interface Result {
  outcome: (typeof OUTCOMES)[number] | null;
  time: number;
  way: number;
  /** Distances to the goal: true and estimated. */
  distance: number;
  believed: number;
  clearance: number;
  ticks: number;
  hash: string;
}

export interface Table {
  rows: number;
  columns: number;
  /** Raw steps of D and of R between two nodes. */
  spacing: [d: number, r: number];
  /** Turn and step of node after node, raw, R first. */
  nodes: Float64Array;
}

/** The bits of host/lab/play/rule_faults.hpp. */
export const RULE_FAULTS = {
  turnNotMirrored: 1,
  stepNotMirrored: 2,
  turnsTowardsNearer: 4,
  turnsLessNear: 8,
  stepsLongerNear: 16,
} as const;

const WORDS = {
  modes: 0,
  whys: 1,
  faults: 2,
  kinds: 3,
  guides: 4,
  planners: 5,
  abouts: 6,
  reasons: 7,
} as const;

function flags({guarded, nods, assist}: Switches): [number, number, number] {
  return [Number(guarded), Number(nods), Number(assist)];
}

export class Core {
  readonly words: Record<keyof typeof WORDS, string[]>;
  readonly robot: RobotInfo;

  constructor(private readonly wasm: Exports) {
    wasm._initialize();
    this.words = Object.fromEntries(
      Object.entries(WORDS).map(([name, which]) => [name, this.wordsOf(which)]),
    ) as Record<keyof typeof WORDS, string[]>;
    this.robot = this.robotOf(-1);
  }

  static async load(bytes: Uint8Array): Promise<Core> {
    const {instance} = await WebAssembly.instantiate(bytes as BufferSource, {});
    return new Core(instance.exports as unknown as Exports);
  }

  /** The robot on this side; -1: the reference robot. */
  robotOf(side: number): RobotInfo {
    const [radius, track, max_speed, side_angle, cone, min_range, max_range, offset, cell, turn, period] =
      this.read(this.wasm.robot(side));
    const pi = Math.PI;
    return {
      radius, track, max_speed, min_range, max_range, offset, cell, period,
      side_angle: side_angle * pi, cone: cone * pi, base_turn: turn * pi,
    }; // prettier-ignore
  }

  /** Null if no world of that kind exists for this seed. */
  generate(kind: string, seed: number, noise: boolean): Situation | null {
    const count = this.wasm.generate(this.words.kinds.indexOf(kind), seed, -1, 0, Number(noise));
    return count > 0 ? situationOf(this.read(count)) : null;
  }

  judge(situation: Situation): 'good' | 'none' | 'touches' {
    this.write(flat(situation));
    return (['good', 'none', 'touches'] as const)[this.wasm.judge()];
  }

  begin(side: number, planner: string, situation: Situation): void {
    this.write(flat(situation));
    if (!this.wasm.begin(side, this.words.planners.indexOf(planner)))
      throw new Error('this world is not valid');
  }

  /** A robot on side 0 that the user drives. */
  beginGuard(switches: Switches, situation: Situation): void {
    this.write(flat(situation));
    if (!this.wasm.begin_guard(...flags(switches))) throw new Error('this world is not valid');
  }

  setGuard(switches: Switches): void {
    this.wasm.set_guard(...flags(switches));
  }

  /** m/s and rad/s; it holds until the next one. */
  command(forward: number, turning: number): void {
    this.wasm.command(forward, turning);
  }

  grant(): Grant {
    const [guarded, reason, v, omega, ofV, ofOmega] = this.read(this.wasm.grant());
    return {
      guarded: guarded > 0,
      reason: this.words.reasons[reason],
      asked: {forward: v, turning: omega},
      share: {forward: ofV, turning: ofOmega},
    };
  }

  /** Obstacles and goal, while the robot drives. */
  change(side: number, situation: Situation): void {
    this.write(flat(situation));
    if (!this.wasm.change(side)) throw new Error('this world is not valid');
  }

  advance(side: number, ticks: number): void {
    this.wasm.advance(side, ticks);
  }

  record(side: number, into: Map<string, Float64Array>): void {
    const values = this.read(this.wasm.record(side));
    COLUMNS.forEach((name, i) => {
      const column = into.get(name);
      if (column) column[0] = values[i];
      else into.set(name, Float64Array.of(values[i]));
    });
  }

  result(side: number): Result {
    const [outcome, time, way, distance, believed, clearance, ticks, ...hash] = this.read(
      this.wasm.result(side),
    );
    return {
      outcome: OUTCOMES[outcome] ?? null,
      time, way, distance, believed, clearance, ticks,
      hash: hash.map((part) => part.toString(16).padStart(4, '0')).join(''),
    }; // prettier-ignore
  }

  /** x, y and the class of the path, point after point. */
  way(side: number, from: number): Float64Array {
    return this.read(this.wasm.way(side, from));
  }

  clearCells(side: number): Float64Array {
    return this.read(this.wasm.clear_cells(side));
  }

  /** 0: its planner has no map. */
  mapBytes(side: number): number {
    return this.wasm.map_bytes(side);
  }

  /** Columns, rows, side of a cell, corner, states, and cells of the planned path; empty without a map. */
  map(side: number): Float64Array {
    return this.read(this.wasm.map(side));
  }

  /** 25 turns and 25 steps, raw. */
  rules(): number[] {
    return [...this.read(this.wasm.get_rules())];
  }

  /** Returns the bits of RULE_FAULTS. */
  setRules(rules: number[]): number {
    this.write(rules);
    return this.wasm.set_rules();
  }

  /** Turn and step of node after node, raw, R first; until setRules. Unchanged unless 'done'. */
  setTable(nodes: number[], hash: number): 'done' | 'none' | 'damaged' {
    this.write(nodes);
    return (['done', 'none', 'damaged'] as const)[this.wasm.set_table(hash)];
  }

  atFault(d: number, r: number): boolean {
    return this.wasm.at_fault(d, r) !== 0;
  }

  table(): Table {
    const all = this.read(this.wasm.get_table());
    return {rows: all[0], columns: all[1], spacing: [all[2], all[3]], nodes: all.slice(4)};
  }

  /** Turn and step in thousandths, sample after sample. */
  samples(): Float64Array {
    return this.read(this.wasm.sample_table());
  }

  write(numbers: number[]): void {
    const at = this.wasm.list(numbers.length);
    new Float64Array(this.wasm.memory.buffer, at, numbers.length).set(numbers);
  }

  /** A copy: the memory moves when it grows. */
  private read(count: number): Float64Array {
    const at = this.wasm.list(count);
    return new Float64Array(this.wasm.memory.buffer, at, count).slice();
  }

  private wordsOf(which: number): string[] {
    const words: string[] = [];
    for (let at = this.wasm.word(which, 0); at !== 0; at = this.wasm.word(which, words.length)) {
      const bytes = new Uint8Array(this.wasm.memory.buffer, at);
      words.push(new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0))));
    }
    return words;
  }
}
