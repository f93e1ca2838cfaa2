/** A lane with what was asked as a line and what was granted as an area in the colour of the reason. */
import type {Grants} from './grants.ts';
import type {Lane, Strip} from './lanes.ts';
import type {Palette} from './theme.ts';

export class ChartLane implements Lane {
  readonly rows = 1.6;
  private readonly most: number;
  private readonly least: number;

  constructor(
    readonly name: string,
    private readonly grants: Grants,
    private readonly part: 'forward' | 'turning',
  ) {
    this.most = grants.most(part);
    const lowest = grants.asked[part].reduce((low, value) => Math.min(low, value), 0);
    this.least = lowest < -0.02 * this.most ? -this.most : 0;
  }

  grow(): void {}
  reset(): void {}
  changes(): number[] {
    return [];
  }

  draw(c: CanvasRenderingContext2D, p: Palette, strip: Strip): void {
    const {grants, part} = this;
    const asked = grants.asked[part];
    const granted = grants.granted[part];
    const {y: top, width, height, x} = strip;
    const y = (value: number) => {
      const held = Math.max(this.least, Math.min(this.most, value));
      return top + 1 + (height - 2) * ((this.most - held) / (this.most - this.least));
    };
    c.fillStyle = p.grid;
    c.fillRect(0, top, width, height);
    // Column by column: a column may hold many ticks.
    const perPixel = asked.length / Math.max(1, width);
    for (let px = 0; px < width; ++px) {
      const from = Math.floor(px * perPixel);
      const to = Math.max(from + 1, Math.floor((px + 1) * perPixel));
      let sum = 0;
      for (let tick = from; tick < to && tick < granted.length; ++tick) sum += granted[tick];
      const mean = sum / (to - from);
      c.fillStyle = p[grants.colour(Math.min(asked.length - 1, (from + to) >> 1))];
      c.fillRect(px, Math.min(y(0), y(mean)), 1.05, Math.abs(y(mean) - y(0)));
    }
    c.strokeStyle = p.ink;
    c.lineWidth = 1;
    c.beginPath();
    c.moveTo(0, y(asked[0]));
    for (let tick = 1; tick < asked.length; ++tick) {
      if (asked[tick] !== asked[tick - 1]) {
        c.lineTo(x(tick), y(asked[tick - 1]));
        c.lineTo(x(tick), y(asked[tick]));
      }
    }
    c.lineTo(width, y(asked[asked.length - 1]));
    c.stroke();
  }
}
