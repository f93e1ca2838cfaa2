/** A planner's map and its way point. Lengths are metres; the canvas has the axes of the robot's estimate. */
import type {MapInfo} from './film.ts';
import type {Colour, Palette} from './theme.ts';

/** The map at one tick. */
export interface MapSeen {
  readonly info: MapInfo;
  /** Shows the last picture at or before this tick and returns that picture's tick, or -1 before the first. */
  seek(tick: number): number;
  /** First cell of its window, in cells of the world. */
  readonly corner: [x: number, y: number];
  /** As planning::CellState numbers it, of a cell of the world within the window. */
  state(x: number, y: number): number;
  /** The planned path goes through this cell. */
  onWay(x: number, y: number): boolean;
}

/** By planning::CellState; unknown cells have no colour. */
const COLOURS: (Colour | null)[] = [null, 'map-free', 'map-suspect', 'map-occupied'];

export class MapScenery {
  private readonly cells = COLOURS.map(() => new Path2D());
  private plan: [x: number, y: number][] = [];
  private shown = -1;

  constructor(private readonly map: MapSeen) {}

  draw(c: CanvasRenderingContext2D, p: Palette, pixel: number, tick: number): void {
    const picture = this.map.seek(tick);
    if (picture < 0) return;
    if (picture !== this.shown) this.gather(picture);
    COLOURS.forEach((colour, state) => {
      if (!colour) return;
      c.fillStyle = p[colour];
      c.fill(this.cells[state]);
    });
    this.drawWindow(c, p, pixel);
    this.drawPlan(c, p, pixel);
  }

  /** The way point, and the line of sight to it. */
  drawWayPoint(
    c: CanvasRenderingContext2D,
    p: Palette,
    pixel: number,
    from: [x: number, y: number],
    to: [x: number, y: number],
  ): void {
    c.strokeStyle = c.fillStyle = p.map;
    c.lineWidth = 1.25 * pixel;
    c.setLineDash([4 * pixel, 4 * pixel]);
    c.beginPath();
    c.moveTo(...from);
    c.lineTo(...to);
    c.stroke();
    c.setLineDash([]);
    c.lineWidth = 2 * pixel;
    c.beginPath();
    c.arc(to[0], to[1], 6 * pixel, 0, 2 * Math.PI);
    c.stroke();
    c.beginPath();
    c.arc(to[0], to[1], 2 * pixel, 0, 2 * Math.PI);
    c.fill();
  }

  /** Cells of one state in a row are one box. */
  private gather(picture: number): void {
    this.shown = picture;
    const {map} = this;
    const {columns, rows, cell} = map.info;
    const [left, bottom] = map.corner;
    this.cells.forEach((_, state) => (this.cells[state] = new Path2D()));
    this.plan = [];
    for (let y = bottom; y < bottom + rows; ++y) {
      for (let from = left; from < left + columns;) {
        const state = map.state(from, y);
        let to = from + 1;
        while (to < left + columns && map.state(to, y) === state) ++to;
        if (state !== 0) this.cells[state].rect(from * cell, y * cell, (to - from) * cell, cell);
        from = to;
      }
      for (let x = left; x < left + columns; ++x) {
        if (map.onWay(x, y)) this.plan.push([(x + 0.5) * cell, (y + 0.5) * cell]);
      }
    }
  }

  private drawWindow(c: CanvasRenderingContext2D, p: Palette, pixel: number): void {
    const {columns, rows, cell} = this.map.info;
    const [x, y] = this.map.corner;
    c.strokeStyle = p.map;
    c.globalAlpha = 0.6;
    c.lineWidth = pixel;
    c.strokeRect(x * cell, y * cell, columns * cell, rows * cell);
    c.globalAlpha = 1;
  }

  private drawPlan(c: CanvasRenderingContext2D, p: Palette, pixel: number): void {
    const radius = 1.5 * pixel;
    c.fillStyle = p.map;
    c.beginPath();
    for (const [x, y] of this.plan) {
      c.moveTo(x + radius, y);
      c.arc(x, y, radius, 0, 2 * Math.PI);
    }
    c.fill();
  }
}
