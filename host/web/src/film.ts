/** The clearance patch over time, as host/page/film.hpp stores it. */

const SIDE = 64;
const REACH = 20;

export class Film {
  /** Bit x mod 64 of row y mod 64 is cell (x, y). */
  private readonly picture = new Uint32Array(SIDE * 2);
  private readonly firstChange = [0];
  ticks = new Float64Array();
  private words = new Float64Array();
  private bits = new Float64Array();
  /** Frames that the picture holds; -1: none yet. */
  private shown = -1;

  /** All frames, of which those that were known stay as they are. */
  grow(ticks: Float64Array, changes: Float64Array, words: Float64Array, bits: Float64Array): void {
    Object.assign(this, {ticks, words, bits});
    const first = this.firstChange;
    for (let i = first.length - 1; i < ticks.length; ++i) first.push(first[i] + changes[i]);
  }

  /** Shows the last frame at or before this tick and returns that frame's tick, or -1 before the first. */
  seek(tick: number): number {
    const frame = this.frameAt(tick);
    while (this.shown < frame) this.turn(++this.shown);
    while (this.shown > frame) this.turn(this.shown--);
    return frame < 0 ? -1 : this.ticks[frame];
  }

  /** Calls back for every clear cell around the body's own cell, row by row. */
  forEachClear(bodyX: number, bodyY: number, clear: (x: number, y: number) => void): void {
    for (let y = bodyY - REACH; y <= bodyY + REACH; ++y) {
      const row = 2 * (((y % SIDE) + SIDE) % SIDE);
      if (this.picture[row] === 0 && this.picture[row + 1] === 0) continue;
      for (let x = bodyX - REACH; x <= bodyX + REACH; ++x) {
        const column = ((x % SIDE) + SIDE) % SIDE;
        if ((this.picture[row + (column >> 5)] >>> (column & 31)) & 1) clear(x, y);
      }
    }
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
