/** What the robot senses, in a view that turns with it: ahead is up. */
import {Camera} from './camera.ts';
import type {CommandArcs} from './command_arcs.ts';
import {BEAMS, RangeStatus, type Seen} from './data.ts';
import {element, setText, Surface} from './dom.ts';
import type {Scenery} from './scenery.ts';
import type {Theme} from './theme.ts';
import {bendOf} from './table_use.ts';
import {metres} from './words.ts';

/** Metres from the body to the nearest side, for the reference body of 0.09 m. */
const AROUND = 0.62;
const REFERENCE_RADIUS = 0.09;

const NO_DISTANCE: Partial<Record<RangeStatus, string>> = {
  [RangeStatus.clear]: 'clear',
  [RangeStatus.tooNear]: 'too near',
  [RangeStatus.invalid]: 'lost',
  [RangeStatus.stale]: 'stale',
};

export class CloseUp {
  private readonly surface: Surface;
  private readonly camera = new Camera();

  constructor(
    public run: Seen,
    private readonly player: {readonly tick: number},
    private readonly theme: Theme,
    public scenery: Scenery,
    public commands: CommandArcs | null = null,
  ) {
    this.surface = new Surface(element<HTMLCanvasElement>('closeup'), () => this.draw());
  }

  draw(): void {
    const {run, camera, surface, scenery} = this;
    const p = this.theme.palette;
    const tick = this.player.tick;
    const x = run.column('x_m')[tick];
    const y = run.column('y_m')[tick];
    const heading = run.column('heading_rad')[tick];
    const around = (AROUND * run.info.robot.radius) / REFERENCE_RADIUS;
    camera.scale = Math.min(surface.width, surface.height) / 2 / around;
    camera.turn = Math.PI / 2 - heading;
    // The body sits below the middle: its beams look ahead.
    const back = 0.3 * around;
    camera.x = x + back * Math.cos(heading);
    camera.y = y + back * Math.sin(heading);

    const c = surface.clear();
    c.fillStyle = p.unknown;
    c.fillRect(0, 0, surface.width, surface.height);
    c.save();
    camera.apply(c, surface.width, surface.height);
    const pixel = 1 / camera.scale;
    scenery.drawPatch(c, p, tick);
    scenery.drawObstacles(c, p, pixel, run.t[tick]);
    scenery.drawGoal(c, p, pixel);
    scenery.drawBeams(c, p, pixel, tick);
    this.drawArrows(c, pixel, tick);
    this.commands?.draw(c, p, pixel, tick);
    scenery.drawBody(c, p, pixel, tick);
    c.restore();
    this.label(tick);
  }

  /** The directions of the goal and of the way point, and the heading that the response table requests. */
  private drawArrows(c: CanvasRenderingContext2D, pixel: number, tick: number): void {
    const {run} = this;
    const p = this.theme.palette;
    const at = (name: string) => run.column(name)[tick];
    const [goalX, goalY] = run.info.world.goal;
    const dx = goalX - at('est_x_m');
    const dy = goalY - at('est_y_m');
    const reach = run.info.robot.radius * 3;
    if (Math.hypot(dx, dy) < reach) return;
    // All from the robot's estimate, rotated into the true world.
    const turn = at('heading_rad') - at('est_heading_rad');
    const toGoal = Math.atan2(dy, dx) + turn;
    const led = run.guide(tick) === 'place';
    const ahead = led
      ? Math.atan2(at('way_y_m') - at('est_y_m'), at('way_x_m') - at('est_x_m')) + turn
      : toGoal;
    const arrow = (direction: number, length: number, colour: string, dashed: boolean) => {
      const tip = (r: number, side: number): [number, number] => [
        at('x_m') + r * Math.cos(direction + side),
        at('y_m') + r * Math.sin(direction + side),
      ];
      c.strokeStyle = colour;
      c.lineWidth = 2.5 * pixel;
      c.lineCap = 'round';
      c.setLineDash(dashed ? [5 * pixel, 5 * pixel] : []);
      c.beginPath();
      c.moveTo(...tip(run.info.robot.radius * 1.15, 0));
      c.lineTo(...tip(length, 0));
      c.stroke();
      c.setLineDash([]);
      c.beginPath();
      c.moveTo(...tip(length - 9 * pixel, 0.05));
      c.lineTo(...tip(length, 0));
      c.lineTo(...tip(length - 9 * pixel, -0.05));
      c.stroke();
    };
    arrow(toGoal, reach * 1.25, p.goal, true);
    if (led) arrow(ahead, reach * 1.25, p.map, true);
    const bend = bendOf(run, tick);
    if (bend !== 0) arrow(ahead + bend, reach, p.table, false);
  }

  private label(tick: number): void {
    BEAMS.forEach((beam, i) => {
      const status = this.run.column(`${beam}_status`)[tick] as RangeStatus;
      setText(`beam-${beam}`, NO_DISTANCE[status] ?? metres(this.run.range(i, tick)!));
    });
  }
}
