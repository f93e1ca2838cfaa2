/** The local grid and the map over time, as host/harness/run/film.hpp and map_film.hpp beside it store them. */
import {PLANNED} from './legend.ts';

/** A sequence of bit pictures, each stored as its changes since the one before. */
class Pictures {
  protected readonly picture: Uint32Array;
  private readonly firstChange = [0];
  ticks = new Float64Array();
  private words = new Float64Array();
  private bits = new Float64Array();
  /** Number of the picture that is held; -1: none yet. */
  protected shown = -1;

  constructor(words: number) {
    this.picture = new Uint32Array(words);
  }

  /** Sets all pictures; those already known must not differ. */
  grow(ticks: Float64Array, changes: Float64Array, words: Float64Array, bits: Float64Array): void {
    Object.assign(this, {ticks, words, bits});
    const first = this.firstChange;
    for (let i = first.length - 1; i < ticks.length; ++i) first.push(first[i] + changes[i]);
  }

  /** Shows the last picture at or before this tick and returns that picture's tick, or -1 before the first. */
  seek(tick: number): number {
    const frame = this.frameAt(tick);
    while (this.shown < frame) this.turn(++this.shown);
    while (this.shown > frame) this.turn(this.shown--);
    return frame < 0 ? -1 : this.ticks[frame];
  }

  private turn(frame: number): void {
    for (let i = this.firstChange[frame]; i < this.firstChange[frame + 1]; ++i) {
      this.picture[this.words[i]] ^= this.bits[i];
    }
  }

  private frameAt(tick: number): number {
    let low = -1;
    let high = this.ticks.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.ticks[middle] <= tick) low = middle;
      else high = middle - 1;
    }
    return low;
  }
}

function wrapped(cell: number, count: number): number {
  return ((cell % count) + count) % count;
}

const SIDE = 64;
const REACH = 20;

/** The local grid: bit x mod 64 of row y mod 64 is cell (x, y). */
export class Film extends Pictures {
  constructor() {
    super(SIDE * 2);
  }

  /** Calls back for every clear cell around the body's own cell, row by row. */
  forEachClear(bodyX: number, bodyY: number, clear: (x: number, y: number) => void): void {
    for (let y = bodyY - REACH; y <= bodyY + REACH; ++y) {
      const row = 2 * wrapped(y, SIDE);
      if (this.picture[row] === 0 && this.picture[row + 1] === 0) continue;
      for (let x = bodyX - REACH; x <= bodyX + REACH; ++x) {
        const column = wrapped(x, SIDE);
        if ((this.picture[row + (column >> 5)] >>> (column & 31)) & 1) clear(x, y);
      }
    }
  }
}

/** Size of a map, and of its cells in metres. */
export interface MapInfo {
  bytes: number;
  columns: number;
  rows: number;
  cell: number;
}

/** The map of a planner: two planes with the state of each cell, and one with the plan's way. */
export class MapFilm extends Pictures {
  private x = new Float64Array();
  private y = new Float64Array();
  /** What occurs in its pictures, for showMapKeys. */
  readonly holds = new Set<number>();
  private readonly rowWords: number;
  private scanned = 0;

  constructor(readonly info: MapInfo) {
    super((3 * info.columns * info.rows) / 32);
    this.rowWords = info.columns / 32;
  }

  /** The windows of all pictures. */
  growWindows(x: Float64Array, y: Float64Array): void {
    Object.assign(this, {x, y});
    for (; this.scanned < this.ticks.length; ++this.scanned) {
      this.seek(this.ticks[this.scanned]);
      this.scan();
    }
  }

  private scan(): void {
    const {picture, holds} = this;
    const plane = picture.length / 3;
    for (let i = 0; i < plane; ++i) {
      const [high, low] = [picture[i], picture[i + plane]];
      if (low & ~high) holds.add(1);
      if (high & ~low) holds.add(2);
      if (high & low) holds.add(3);
      if (picture[i + 2 * plane]) holds.add(PLANNED);
    }
  }

  /** First cell of the window of the picture that is shown, in cells of the world. */
  get corner(): [x: number, y: number] {
    return [this.x[this.shown], this.y[this.shown]];
  }

  /** As planning::CellState numbers it, of a cell of the world within the window. */
  state(x: number, y: number): number {
    return 2 * this.bit(0, x, y) + this.bit(1, x, y);
  }

  onWay(x: number, y: number): boolean {
    return this.bit(2, x, y) !== 0;
  }

  private bit(plane: number, x: number, y: number): number {
    const {columns, rows} = this.info;
    const column = wrapped(x, columns);
    const word = (plane * rows + wrapped(y, rows)) * this.rowWords + (column >> 5);
    return (this.picture[word] >>> (column & 31)) & 1;
  }
}
