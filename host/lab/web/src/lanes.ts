/** Lanes of the timeline: what each tick was, over the whole run. */
import type {Colour, Palette} from './theme.ts';

/** The part of a canvas that a lane fills; `x` places a tick. */
export interface Strip {
  y: number;
  width: number;
  height: number;
  x(tick: number): number;
}

export interface Lane {
  readonly name: string;
  /** Of a row of blocks. */
  readonly rows: number;
  /** The run has more ticks. */
  grow(): void;
  draw(c: CanvasRenderingContext2D, p: Palette, strip: Strip): void;
  /** Ticks at which it changes, for the keys that go from change to change. */
  changes(): number[];
  /** Its old ticks may look different, too. */
  reset(): void;
}

interface Segment {
  from: number;
  /** The first tick after it. */
  to: number;
  label: string;
  colour: Colour;
}

/** Blocks with a label and a colour. */
export class BlockLane implements Lane {
  readonly rows = 1;
  private readonly segments: Segment[] = [];

  constructor(
    readonly name: string,
    private readonly run: {readonly ticks: number},
    private readonly says: (tick: number) => [label: string, colour: Colour],
    private readonly stops = true,
  ) {}

  grow(): void {
    const all = this.segments;
    for (let tick = all.at(-1)?.to ?? 0; tick < this.run.ticks; ++tick) {
      const [label, colour] = this.says(tick);
      const last = all[all.length - 1];
      if (last && last.label === label && last.colour === colour) last.to = tick + 1;
      else all.push({from: tick, to: tick + 1, label, colour});
    }
  }

  reset(): void {
    this.segments.length = 0;
    this.grow();
  }

  colours(): Set<Colour> {
    return new Set(this.segments.map(({colour}) => colour));
  }

  changes(): number[] {
    return this.stops ? this.segments.map(({from}) => from) : [];
  }

  draw(c: CanvasRenderingContext2D, p: Palette, {y, width, height, x}: Strip): void {
    for (const {from, to, colour} of this.segments) {
      const x0 = x(from);
      c.fillStyle = p[colour];
      c.fillRect(x0, y, Math.max(0.75, x(to) - x0), height);
    }
    for (const {from, to, label, colour} of this.segments) {
      const x0 = Math.max(0, x(from));
      const room = Math.min(width, x(to)) - x0;
      if (c.measureText(label).width + 10 > room) continue;
      c.fillStyle = colour === 'still' ? p.ink : p.panel;
      c.fillText(label, x0 + 5, y + height / 2 + 0.5);
    }
  }
}
