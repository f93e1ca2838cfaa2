/** The world of one robot from above. Its objects can be dragged. */
import {drawGrid, drawGround, drawLineToGoal, drawScaleBar} from '../backdrop.ts';
import type {Camera} from '../camera.ts';
import type {Point, World} from '../data.ts';
import {Surface} from '../dom.ts';
import {listenToHands} from '../hands.ts';
import {Scenery} from '../scenery.ts';
import {moverPosition, polyline} from '../shapes.ts';
import type {Palette, Theme} from '../theme.ts';
import type {LiveRun} from './live.ts';
import {thingAt, type Thing} from './things.ts';

/** A press this many pixels beside an object still selects it. */
const GRIP = {mouse: 8, touch: 18};

export interface Grip {
  take(thing: Thing | null): void;
  /** Moves by this many metres since the last call; the first call comes with the first movement. */
  drag(dx: number, dy: number): void;
  drop(): void;
  /** The user moved the camera. */
  looked(): void;
}

export class View {
  readonly surface: Surface;
  scenery: Scenery;
  private dragged: {id: number; x: number; y: number} | null = null;

  constructor(
    readonly canvas: HTMLCanvasElement,
    public run: LiveRun,
    private readonly camera: Camera,
    private readonly theme: Theme,
    private readonly grip: Grip,
    resized: () => void,
  ) {
    this.surface = new Surface(canvas, resized);
    this.scenery = new Scenery(run);
    this.listen();
    listenToHands(canvas, {
      zoom: (factor, x, y) => {
        camera.zoom(factor, x, y, this.surface.width, this.surface.height);
        grip.looked();
      },
      pan: (dx, dy) => {
        camera.x -= dx / camera.scale;
        camera.y += dy / camera.scale;
        grip.looked();
      },
      oneFingerPans: () => false,
    });
  }

  /** The world or the run has changed. */
  show(run: LiveRun): void {
    this.run = run;
    this.scenery = new Scenery(run);
  }

  draw(selected: Thing | null): void {
    const {run, camera, surface, scenery} = this;
    const p = this.theme.palette;
    const {world} = run.info;
    const c = surface.clear();
    const pixel = 1 / camera.scale;
    c.save();
    drawGround(c, p, camera, surface, world.bounds);
    camera.apply(c, surface.width, surface.height);
    drawGrid(c, p, camera, surface);
    drawLineToGoal(c, p, pixel, world);
    scenery.drawPatch(c, p, 0);
    scenery.drawObstacles(c, p, pixel, run.t[0]);
    scenery.drawMap(c, p, pixel, 0);
    if (selected) this.drawSelected(c, p, pixel, world, selected);
    scenery.drawGoal(c, p, pixel);
    this.drawWay(c, p, pixel);
    scenery.drawBeams(c, p, pixel, 0);
    run.arcs?.draw(c, p, pixel, 0);
    scenery.drawBody(c, p, pixel, 0);
    c.restore();
    this.drawWords(c, p, world);
    drawScaleBar(c, p, camera, surface);
  }

  private drawWay(c: CanvasRenderingContext2D, p: Palette, pixel: number): void {
    c.lineJoin = 'round';
    c.lineCap = 'butt';
    const {colours, widths} = this.run.looks;
    for (const {kind, path} of this.run.stretches) {
      c.strokeStyle = p[colours[kind]];
      c.lineWidth = widths[kind] * pixel;
      c.stroke(path);
    }
  }

  private drawSelected(
    c: CanvasRenderingContext2D,
    p: Palette,
    pixel: number,
    world: World,
    thing: Thing,
  ): void {
    c.strokeStyle = p.free;
    c.lineWidth = 3 * pixel;
    c.beginPath();
    const ring = ([x, y]: Point, radius: number) => c.arc(x, y, radius + 3 * pixel, 0, 2 * Math.PI);
    if (thing.kind === 'goal') ring(world.goal, Math.max(world.tolerance, 6 * pixel));
    else if (thing.kind === 'start') ring(world.start, this.run.info.robot.radius);
    else if (thing.kind === 'disc')
      ring([world.discs[thing.index][0], world.discs[thing.index][1]], world.discs[thing.index][2]);
    else if (thing.kind === 'mover')
      ring(moverPosition(world.movers[thing.index], this.run.t[0]), world.movers[thing.index].radius);
    else if (thing.kind === 'polygon') c.stroke(polyline(world.polygons[thing.index], true));
    else c.stroke(polyline(world.walls[thing.index]));
    c.stroke();
  }

  private drawWords(c: CanvasRenderingContext2D, p: Palette, world: World): void {
    const {camera, surface} = this;
    c.font = '600 12px Inter, system-ui, sans-serif';
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    const word = (text: string, at: Point, dy: number, colour: string) => {
      const [x, y] = camera.toScreen(at[0], at[1], surface.width, surface.height);
      c.lineWidth = 4;
      c.lineJoin = 'round';
      c.strokeStyle = p.ground;
      c.strokeText(text, x, y + dy);
      c.fillStyle = colour;
      c.fillText(text, x, y + dy);
    };
    word('start', world.start, Math.max(8, this.run.info.robot.radius * camera.scale) + 12, p.muted);
    word('goal', world.goal, -Math.max(8, world.tolerance * camera.scale) - 12, p.goal);
    if (this.run.result.outcome !== 'contact') return;
    const at: Point = [this.run.column('x_m')[0], this.run.column('y_m')[0]];
    const [x, y] = camera.toScreen(at[0], at[1], surface.width, surface.height);
    const radius = Math.max(8, this.run.info.robot.radius * camera.scale) + 5;
    c.beginPath();
    c.arc(x, y, radius, 0, 2 * Math.PI);
    c.strokeStyle = p.contact;
    c.lineWidth = 3;
    c.stroke();
    word('contact', at, -radius - 10, p.contact);
  }

  /** Takes presses first: a press on an object drags that object, any other press moves the view. */
  private listen(): void {
    const {canvas, camera, surface} = this;
    const under = (x: number, y: number, touch: boolean) =>
      thingAt(
        this.run.info.world,
        camera.toWorld(x, y, surface.width, surface.height),
        (touch ? GRIP.touch : GRIP.mouse) / camera.scale,
      );
    canvas.addEventListener('pointerdown', (event) => {
      const thing = under(event.offsetX, event.offsetY, event.pointerType === 'touch');
      this.grip.take(thing);
      if (!thing) return;
      event.stopImmediatePropagation();
      canvas.setPointerCapture(event.pointerId);
      this.dragged = {id: event.pointerId, x: event.offsetX, y: event.offsetY};
    });
    canvas.addEventListener('pointermove', (event) => {
      if (this.dragged?.id !== event.pointerId) {
        if (event.pointerType === 'mouse' && event.buttons === 0) {
          canvas.style.cursor = under(event.offsetX, event.offsetY, false) ? 'move' : 'grab';
        }
        return;
      }
      event.stopImmediatePropagation();
      const {x, y} = this.dragged;
      this.dragged = {id: event.pointerId, x: event.offsetX, y: event.offsetY};
      this.grip.drag((event.offsetX - x) / camera.scale, (y - event.offsetY) / camera.scale);
    });
    for (const type of ['pointerup', 'pointercancel'] as const) {
      canvas.addEventListener(type, (event) => {
        if (this.dragged?.id !== event.pointerId) return;
        this.dragged = null;
        this.grip.drop();
      });
    }
    // A finger on an object does not scroll the page.
    canvas.addEventListener(
      'touchstart',
      (event) => {
        const [touch] = event.touches;
        const box = canvas.getBoundingClientRect();
        if (under(touch.clientX - box.left, touch.clientY - box.top, true)) event.preventDefault();
      },
      {passive: false},
    );
  }
}
