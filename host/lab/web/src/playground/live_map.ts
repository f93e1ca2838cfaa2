/** The current map of a robot, as host/lab/play/exports.cpp exports it. */
import type {MapInfo} from '../film.ts';
import {PLANNED} from '../legend.ts';
import type {MapSeen} from '../map_scenery.ts';

export class LiveMap implements MapSeen {
  info: MapInfo;
  corner: [x: number, y: number] = [0, 0];
  private states: Float64Array = new Float64Array();
  private way = new Set<number>();
  /** What has occurred in its pictures, for showMapKeys. */
  readonly holds = new Set<number>();
  /** Pictures so far. */
  private count = 0;

  constructor(private readonly bytes: number) {
    this.info = {bytes, columns: 0, rows: 0, cell: 1};
  }

  /** Takes a new picture, or the last one again. */
  show(told: Float64Array): void {
    const [columns, rows, cell, x, y] = told;
    this.info = {bytes: this.bytes, columns, rows, cell};
    this.corner = [x, y];
    this.states = told.subarray(5, 5 + columns * rows);
    this.way.clear();
    for (let i = 5 + columns * rows; i < told.length; i += 2) this.way.add(told[i] + columns * told[i + 1]);
    ++this.count;
    for (const state of this.states) this.holds.add(state);
    if (this.way.size > 0) this.holds.add(PLANNED);
  }

  seek(): number {
    return this.count - 1;
  }
  state(x: number, y: number): number {
    return this.states[this.cell(x, y)];
  }
  onWay(x: number, y: number): boolean {
    return this.way.has(this.cell(x, y));
  }

  private cell(x: number, y: number): number {
    return x - this.corner[0] + this.info.columns * (y - this.corner[1]);
  }
}
