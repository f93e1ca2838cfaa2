/** The world from above: the path driven so far, coloured by what the robot did, and the robot. */
import {drawGrid, drawGround, drawLineToGoal, drawScaleBar} from './backdrop.ts';
import {Camera, type Box} from './camera.ts';
import type {CommandArcs} from './command_arcs.ts';
import type {Run} from './data.ts';
import {element, Surface} from './dom.ts';
import type {Player} from './player.ts';
import {listenToHands} from './hands.ts';
import {showMapKeys} from './legend.ts';
import {Scenery} from './scenery.ts';
import {sceneBox} from './scene_box.ts';
import {pathPieces, type Piece} from './shapes.ts';
import type {WayLooks} from './story.ts';
import type {Theme} from './theme.ts';

const FOLLOWED_METRES = 2.6;

export class WorldView {
  private readonly surface: Surface;
  private readonly camera = new Camera();
  private pieces: Piece[] = [];
  private whole = new Path2D();
  private box: Box;
  private following = false;
  private showsMap = true;
  /** The user has moved the view. */
  private moved = false;

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly theme: Theme,
    private readonly scenery: Scenery,
    private readonly way: WayLooks,
    private readonly commands: CommandArcs | null,
  ) {
    this.box = sceneBox(run);
    this.extend();
    const canvas = element<HTMLCanvasElement>('world');
    this.surface = new Surface(canvas, () => {
      if (!this.moved) this.fit();
      this.draw();
    });
    this.fit();
    listenToHands(canvas, {
      zoom: (factor, x, y) => this.zoom(factor, x, y),
      pan: (dx, dy) => this.pan(dx, dy),
      oneFingerPans: () => this.moved,
    });
    element('fit').addEventListener('click', () => this.showAll());
    for (const id of ['show-map', 'key-map']) element(id).hidden = !run.map;
    element('show-map').addEventListener('click', () => this.toggleMap());
    this.showMapKeys();
    element('follow').addEventListener('click', () => this.setFollowing(!this.following));
  }

  /** The run has more ticks. */
  grow(): void {
    this.extend();
    this.showMapKeys();
    const box = sceneBox(this.run);
    const same = (['left', 'bottom', 'right', 'top'] as const).every((side) => box[side] === this.box[side]);
    this.box = box;
    if (!same && !this.moved) this.fit();
  }

  showAll(): void {
    this.setFollowing(false);
    this.moved = false;
    this.fit();
    this.draw();
  }

  setFollowing(on: boolean): void {
    this.following = on;
    element('follow').setAttribute('aria-pressed', String(on));
    if (on) {
      this.moved = true;
      this.camera.scale = Math.min(this.surface.width, this.surface.height) / FOLLOWED_METRES;
      this.touchable();
    }
    this.draw();
  }

  toggleFollowing(): void {
    if (this.following) this.showAll();
    else this.setFollowing(true);
  }

  toggleMap(): void {
    if (!this.run.map) return;
    this.showsMap = !this.showsMap;
    this.showMapKeys();
    this.draw();
  }

  draw(): void {
    const {run, theme, camera, surface, scenery} = this;
    const p = theme.palette;
    const tick = this.player.tick;
    const time = run.t[tick];
    if (this.following) {
      camera.x = run.column('x_m')[tick];
      camera.y = run.column('y_m')[tick];
    }
    const c = surface.clear();
    const pixel = 1 / camera.scale;
    c.save();
    drawGround(c, p, camera, surface, run.info.world.bounds);
    camera.apply(c, surface.width, surface.height);
    drawGrid(c, p, camera, surface);
    drawLineToGoal(c, p, pixel, run.info.world);
    scenery.drawPatch(c, p, tick);
    scenery.drawObstacles(c, p, pixel, time);
    if (this.showsMap) scenery.drawMap(c, p, pixel, tick);
    scenery.drawGoal(c, p, pixel);
    this.drawPath(c, pixel, tick);
    scenery.drawBeams(c, p, pixel, tick);
    this.commands?.draw(c, p, pixel, tick);
    scenery.drawBody(c, p, pixel, tick);
    c.restore();
    this.drawMarks(c, tick);
    drawScaleBar(c, p, camera, surface);
  }

  private showMapKeys(): void {
    element('show-map').setAttribute('aria-pressed', String(this.showsMap));
    showMapKeys((this.showsMap && this.run.map?.holds) || new Set());
  }

  /** The last piece may become longer. */
  private extend(): void {
    const from = this.pieces.pop()?.ticks[0] ?? 0;
    this.pieces.push(...pathPieces(this.run, this.way.column, from));
    this.whole = new Path2D();
    for (const {path} of this.pieces) this.whole.addPath(path);
  }

  private fit(): void {
    this.camera.fit(this.box, this.surface.width, this.surface.height, 18);
    this.touchable();
  }

  /** One finger scrolls the page while the whole world is shown, and moves the view otherwise. */
  private touchable(): void {
    this.surface.canvas.style.touchAction = this.moved ? 'none' : 'pan-y';
  }

  private drawPath(c: CanvasRenderingContext2D, pixel: number, tick: number): void {
    const p = this.theme.palette;
    c.lineJoin = 'round';
    c.lineCap = 'butt';
    c.strokeStyle = p.muted;
    c.globalAlpha = 0.25;
    c.lineWidth = 1.5 * pixel;
    c.stroke(this.whole);
    c.globalAlpha = 1;
    const x = this.run.column('x_m');
    const y = this.run.column('y_m');
    for (const {kind, ticks, path} of this.pieces) {
      if (ticks[0] >= tick) break;
      c.strokeStyle = p[this.way.colours[kind]];
      c.lineWidth = this.way.widths[kind] * pixel;
      if (ticks[ticks.length - 1] <= tick) {
        c.stroke(path);
        continue;
      }
      c.beginPath();
      for (const at of ticks) {
        if (at > tick) break;
        if (at === ticks[0]) c.moveTo(x[at], y[at]);
        else c.lineTo(x[at], y[at]);
      }
      c.lineTo(x[tick], y[tick]);
      c.stroke();
    }
  }

  /** Labels and the numbers of the boundaries, always upright and of one size. */
  private drawMarks(c: CanvasRenderingContext2D, tick: number): void {
    const {camera, surface, run} = this;
    const p = this.theme.palette;
    const {start, goal} = run.info.world;
    const place = (x: number, y: number) => camera.toScreen(x, y, surface.width, surface.height);
    c.font = '600 12px Inter, system-ui, sans-serif';
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    const word = (text: string, at: [number, number], dy: number, colour: string) => {
      c.lineWidth = 4;
      c.lineJoin = 'round';
      c.strokeStyle = p.ground;
      c.strokeText(text, at[0], at[1] + dy);
      c.fillStyle = colour;
      c.fillText(text, at[0], at[1] + dy);
    };
    const below = Math.max(8, run.info.robot.radius * camera.scale) + 12;
    const above = Math.max(8, run.info.world.tolerance * camera.scale) + 12;
    word('start', place(...start), below, p.muted);
    word('goal', place(...goal), -above, p.goal);
    const x = run.column('x_m');
    const y = run.column('y_m');
    if (run.info.result?.outcome === 'contact' && tick === run.ticks - 1) {
      const at = place(x[tick], y[tick]);
      const radius = Math.max(8, run.info.robot.radius * camera.scale) + 5;
      c.beginPath();
      c.arc(at[0], at[1], radius, 0, 2 * Math.PI);
      c.strokeStyle = p.contact;
      c.lineWidth = 3;
      c.stroke();
      word('contact', at, -radius - 10, p.contact);
    }
    run.info.edges.forEach(({hit, left}, i) => {
      if (hit > tick) return;
      const numbered: [number, boolean][] = [[hit, true]];
      if (left !== null && left <= tick) numbered.push([left, false]);
      for (const [at, met] of numbered) {
        const [px, py] = place(x[at], y[at]);
        c.beginPath();
        c.arc(px, py, 8.5, 0, 2 * Math.PI);
        c.fillStyle = met ? p.danger : p.panel;
        c.strokeStyle = met ? p.panel : p.free;
        c.lineWidth = 2;
        c.fill();
        c.stroke();
        c.fillStyle = met ? p.panel : p.ink;
        c.font = '700 11px Inter, system-ui, sans-serif';
        c.fillText(String(i + 1), px, py + 0.5);
      }
    });
  }

  private zoom(factor: number, px: number, py: number): void {
    this.camera.zoom(factor, px, py, this.surface.width, this.surface.height);
    this.movedByHand();
  }

  private pan(dx: number, dy: number): void {
    if (this.following) this.setFollowing(false);
    this.camera.x -= dx / this.camera.scale;
    this.camera.y += dy / this.camera.scale;
    this.movedByHand();
  }

  private movedByHand(): void {
    this.moved = true;
    this.touchable();
    this.draw();
  }
}
