/** The ways that the asked and the granted velocity lead to, drawn at the body. */
import type {Seen} from './data.ts';
import type {Velocity} from './guard_words.ts';
import type {Colour, Palette} from './theme.ts';

/** Seconds that a way lasts. */
const AHEAD = 1.5;
const STEPS = 24;
/** Most turning of a drawn way. */
const MOST_TURN = 0.9 * Math.PI;

/** A command at a tick. */
export interface Commands {
  asked(tick: number): Velocity;
  /** Null without the guard. */
  granted(tick: number): Velocity | null;
  colour(tick: number): Colour;
}

export class CommandArcs {
  constructor(
    private readonly run: Seen,
    private readonly commands: Commands,
  ) {}

  draw(c: CanvasRenderingContext2D, p: Palette, pixel: number, tick: number): void {
    c.lineCap = c.lineJoin = 'round';
    const {commands} = this;
    const granted = commands.granted(tick);
    if (granted) {
      this.way(c, pixel, tick, granted, p.panel, [], 6);
      this.way(c, pixel, tick, granted, p[commands.colour(tick)], [], 3.5);
    }
    // Above the granted way: they often coincide.
    this.way(c, pixel, tick, commands.asked(tick), p.ink, [1.5, 4]);
  }

  private way(
    c: CanvasRenderingContext2D,
    pixel: number,
    tick: number,
    {forward, turning}: Velocity,
    colour: string,
    dash: number[],
    width = 2,
  ): void {
    const {radius, max_speed} = this.run.info.robot;
    const length = Math.max(-1.3 * max_speed, Math.min(1.3 * max_speed, forward)) * AHEAD;
    const turn = Math.max(-MOST_TURN, Math.min(MOST_TURN, turning * AHEAD));
    const onSpot = Math.abs(length) < 0.02;
    if (onSpot && Math.abs(turn) < 0.03) return;
    let x = this.run.column('x_m')[tick];
    let y = this.run.column('y_m')[tick];
    let heading = this.run.column('heading_rad')[tick];
    const body = Math.max(radius, 5 * pixel);
    const ring = 1.5 * body;
    c.strokeStyle = colour;
    c.lineWidth = width * pixel;
    c.setLineDash(dash.map((part) => part * pixel));
    c.beginPath();
    if (onSpot) {
      c.arc(x, y, ring, heading, heading + turn, turn < 0);
      [x, y] = [x + ring * Math.cos(heading + turn), y + ring * Math.sin(heading + turn)];
      heading += turn + (Math.sign(turn) * Math.PI) / 2;
    } else {
      c.moveTo(x, y);
      for (let i = 0; i < STEPS; ++i) {
        heading += turn / STEPS;
        x += (length / STEPS) * Math.cos(heading);
        y += (length / STEPS) * Math.sin(heading);
        c.lineTo(x, y);
      }
      if (length < 0) heading += Math.PI;
    }
    c.stroke();
    c.setLineDash([]);
    const barb = 7 * pixel;
    c.beginPath();
    for (const side of [2.6, -2.6]) {
      c.moveTo(x, y);
      c.lineTo(x + barb * Math.cos(heading + side), y + barb * Math.sin(heading + side));
    }
    c.stroke();
  }
}
