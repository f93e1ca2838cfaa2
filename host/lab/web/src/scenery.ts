/** What both views of the world draw. Lengths are metres; the canvas has the axes of the world. */
import {BEAMS, RangeStatus, type Seen} from './data.ts';
import {MapScenery} from './map_scenery.ts';
import {moverPosition, polyline} from './shapes.ts';
import type {Palette} from './theme.ts';

const TAU = 2 * Math.PI;
/** Of the estimated pose: its place and heading, and their standard deviations along and across the heading. */
const SIGMA = [
  'est_x_m',
  'est_y_m',
  'est_heading_rad',
  'sigma_along_m',
  'sigma_across_m',
  'sigma_heading_rad',
];

export class Scenery {
  private readonly discs = new Path2D();
  private readonly polygons = new Path2D();
  private readonly walls = new Path2D();
  private readonly map: MapScenery | null;

  constructor(private readonly run: Seen) {
    this.map = run.map && new MapScenery(run.map);
    const {discs, polygons, walls} = run.info.world;
    for (const [x, y, radius] of discs) {
      this.discs.moveTo(x + radius, y);
      this.discs.arc(x, y, radius, 0, TAU);
    }
    for (const points of polygons) this.polygons.addPath(polyline(points, true));
    for (const points of walls) this.walls.addPath(polyline(points));
  }

  /** `pixel` is the size of one in metres. */
  drawObstacles(c: CanvasRenderingContext2D, p: Palette, pixel: number, time: number): void {
    const {bounds, movers} = this.run.info.world;
    c.lineJoin = c.lineCap = 'round';
    c.fillStyle = p.obstacle;
    c.strokeStyle = p['obstacle-edge'];
    c.lineWidth = pixel;
    for (const path of [this.discs, this.polygons]) {
      c.fill(path);
      c.stroke(path);
    }
    c.strokeStyle = p.wall;
    c.lineWidth = 2.5 * pixel;
    c.stroke(this.walls);
    if (bounds) c.strokeRect(bounds[0], bounds[1], bounds[2] - bounds[0], bounds[3] - bounds[1]);
    for (const mover of movers) {
      c.strokeStyle = p.mover;
      c.lineWidth = pixel;
      c.setLineDash([3 * pixel, 4 * pixel]);
      c.stroke(polyline(mover.path));
      c.setLineDash([]);
      const [x, y] = moverPosition(mover, time);
      c.beginPath();
      c.arc(x, y, mover.radius, 0, TAU);
      c.fillStyle = p.obstacle;
      c.fill();
      c.lineWidth = 2 * pixel;
      c.stroke();
    }
  }

  drawGoal(c: CanvasRenderingContext2D, p: Palette, pixel: number): void {
    const {goal, tolerance} = this.run.info.world;
    c.strokeStyle = c.fillStyle = p.goal;
    c.lineWidth = 1.5 * pixel;
    c.beginPath();
    c.arc(goal[0], goal[1], Math.max(tolerance, 6 * pixel), 0, TAU);
    c.globalAlpha = 0.22;
    c.fill();
    c.globalAlpha = 1;
    c.stroke();
    const arm = 4 * pixel;
    c.stroke(new Path2D(`M${goal[0] - arm},${goal[1]}h${2 * arm}M${goal[0]},${goal[1] - arm}v${2 * arm}`));
  }

  /** The clear cells, at their place in the true world by the robot's estimate. */
  drawPatch(c: CanvasRenderingContext2D, p: Palette, tick: number): void {
    const {run} = this;
    const {cell} = run.info.robot;
    const frame = run.film.seek(tick);
    if (frame < 0) return;
    const bodyX = Math.floor(run.column('grid_x_m')[frame] / cell + 1e-6);
    const bodyY = Math.floor(run.column('grid_y_m')[frame] / cell + 1e-6);
    this.asBelieved(c, tick, () => {
      c.fillStyle = p.clear;
      c.beginPath();
      run.film.forEachClear(bodyX, bodyY, (x, y) => c.rect(x * cell, y * cell, cell, cell));
      c.fill();
    });
  }

  /** The map with its planned path, likewise, and the way point. */
  drawMap(c: CanvasRenderingContext2D, p: Palette, pixel: number, tick: number): void {
    const {run, map} = this;
    if (!map) return;
    const at = (name: string) => run.column(name)[tick];
    this.asBelieved(c, tick, () => {
      map.draw(c, p, pixel, tick);
      if (run.guide(tick) !== 'place') return;
      map.drawWayPoint(c, p, pixel, [at('grid_x_m'), at('grid_y_m')], [at('way_x_m'), at('way_y_m')]);
    });
  }

  private asBelieved(c: CanvasRenderingContext2D, tick: number, draw: () => void): void {
    const at = (name: string) => this.run.column(name)[tick];
    c.save();
    c.translate(at('x_m'), at('y_m'));
    c.rotate(at('heading_rad') - at('grid_heading_rad'));
    c.translate(-at('grid_x_m'), -at('grid_y_m'));
    draw();
    c.restore();
  }

  drawBeams(c: CanvasRenderingContext2D, p: Palette, pixel: number, tick: number): void {
    const {run} = this;
    const {side_angle, cone, offset} = run.info.robot;
    const heading = run.column('heading_rad')[tick];
    for (let beam = 0; beam < 3; ++beam) {
      const range = run.range(beam, tick);
      if (range === null) continue;
      const axis = heading + side_angle * (1 - beam);
      const x = run.column('x_m')[tick] + offset * Math.cos(axis);
      const y = run.column('y_m')[tick] + offset * Math.sin(axis);
      const hit = run.column(`${BEAMS[beam]}_status`)[tick] !== RangeStatus.clear;
      c.beginPath();
      c.moveTo(x, y);
      c.arc(x, y, range, axis - cone / 2, axis + cone / 2);
      c.closePath();
      c.fillStyle = c.strokeStyle = p[BEAMS[beam]];
      c.globalAlpha = 0.13;
      c.fill();
      c.globalAlpha = 0.45;
      c.lineWidth = pixel;
      c.stroke();
      c.globalAlpha = 1;
      if (!hit) continue;
      c.beginPath();
      c.arc(x, y, range, axis - cone / 2, axis + cone / 2);
      c.lineWidth = 3 * pixel;
      c.stroke();
    }
  }

  /** Two standard deviations around the estimated pose: an ellipse, and a wedge of headings. Nothing if unknown. */
  private drawSigma(c: CanvasRenderingContext2D, p: Palette, pixel: number, tick: number): void {
    const [x, y, heading, along, across, turn] = SIGMA.map((name) => this.run.column(name)[tick]);
    if (!along) return;
    c.fillStyle = c.strokeStyle = p.muted;
    c.lineWidth = pixel;
    c.beginPath();
    c.ellipse(x, y, 2 * along, 2 * across, heading, 0, TAU);
    c.moveTo(x, y);
    c.arc(x, y, 2.5 * this.run.info.robot.radius, heading - 2 * turn, heading + 2 * turn);
    c.closePath();
    c.globalAlpha = 0.2;
    c.fill();
    c.globalAlpha = 1;
    c.stroke();
  }

  /** The body, and a ring at the estimated place if that is elsewhere. */
  drawBody(c: CanvasRenderingContext2D, p: Palette, pixel: number, tick: number): void {
    const {run} = this;
    const at = (name: string) => run.column(name)[tick];
    const radius = run.info.robot.radius;
    const [x, y, heading] = [at('x_m'), at('y_m'), at('heading_rad')];
    if (Math.hypot(at('est_x_m') - x, at('est_y_m') - y) > Math.max(0.01, pixel)) {
      c.strokeStyle = p.muted;
      c.lineWidth = pixel;
      c.setLineDash([3 * pixel, 3 * pixel]);
      c.beginPath();
      c.arc(at('est_x_m'), at('est_y_m'), radius, 0, TAU);
      c.stroke();
      c.setLineDash([]);
    }
    c.fillStyle = p.body;
    c.strokeStyle = p.panel;
    c.lineWidth = 1.5 * pixel;
    c.beginPath();
    c.arc(x, y, Math.max(radius, 5 * pixel), 0, TAU);
    c.fill();
    c.stroke();
    const nose = Math.max(radius, 5 * pixel);
    c.beginPath();
    c.moveTo(x + 0.2 * nose * Math.cos(heading), y + 0.2 * nose * Math.sin(heading));
    c.lineTo(x + 0.9 * nose * Math.cos(heading), y + 0.9 * nose * Math.sin(heading));
    c.lineWidth = Math.max(2 * pixel, 0.16 * nose);
    c.stroke();
    this.drawSigma(c, p, pixel, tick);
  }
}
