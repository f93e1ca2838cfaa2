/** Every mission as a dot: the path driven over the shortest path. */
import {element, Surface} from './dom.ts';
import {roundStep} from './histogram.ts';
import {isGood, type Mission} from './mission.ts';
import type {Theme} from './theme.ts';

const MARGIN = {left: 44, right: 12, top: 10, bottom: 34};
const RATIOS = [1, 2, 5, 10];
/** The worst have a number; the page lists them in the same order. */
const NUMBERED = 8;

export class Scatter {
  private readonly surface: Surface;
  private readonly dots: {mission: Mission; replay: number}[];
  private readonly mostX: number;
  private readonly mostY: number;

  constructor(
    missions: Mission[],
    replayed: number[],
    private readonly theme: Theme,
  ) {
    this.dots = missions
      .map((mission, row) => ({mission, replay: replayed.indexOf(row)}))
      .filter(({mission}) => mission.shortest_m !== null);
    this.mostX = 1.08 * Math.max(1, ...this.dots.map(({mission}) => mission.shortest_m!));
    this.mostY = 1.08 * Math.max(1, ...this.dots.map(({mission}) => mission.path_m));
    element('scatter-figure').hidden = this.dots.length === 0;
    this.surface = new Surface(element<HTMLCanvasElement>('scatter'), () => this.draw());
    this.surface.canvas.addEventListener('click', (event) => this.click(event));
    this.draw();
  }

  draw(): void {
    const {surface} = this;
    const p = this.theme.palette;
    const c = surface.clear();
    c.font = '11px Inter, system-ui, sans-serif';
    this.drawAxes(c);
    for (const {mission, replay} of this.dots) {
      const [x, y] = this.place(mission);
      c.beginPath();
      const numbered = replay >= 0 && replay < NUMBERED;
      c.arc(x, y, numbered ? 8 : 3, 0, 2 * Math.PI);
      c.fillStyle = isGood(mission) ? p.free : p.contact;
      c.globalAlpha = numbered ? 1 : 0.55;
      c.fill();
      c.globalAlpha = 1;
      if (!numbered) continue;
      c.fillStyle = p.panel;
      c.textAlign = 'center';
      c.textBaseline = 'middle';
      c.fillText(String(replay + 1), x, y + 0.5);
    }
  }

  private drawAxes(c: CanvasRenderingContext2D): void {
    const {width, height} = this.surface;
    const p = this.theme.palette;
    const bottom = height - MARGIN.bottom;
    c.strokeStyle = p.grid;
    c.fillStyle = p.muted;
    c.lineWidth = 1;
    c.textAlign = 'center';
    c.textBaseline = 'top';
    const stepX = roundStep(this.mostX, 6);
    for (let x = 0; x <= this.mostX; x += stepX) c.fillText(`${+x.toFixed(6)}`, this.x(x), bottom + 5);
    c.fillText('shortest path, m', (MARGIN.left + width - MARGIN.right) / 2, height - 14);
    c.textAlign = 'right';
    c.textBaseline = 'middle';
    const stepY = roundStep(this.mostY, 6);
    for (let y = 0; y <= this.mostY; y += stepY) {
      c.fillText(`${+y.toFixed(6)} m`, MARGIN.left - 6, this.y(y));
      c.stroke(new Path2D(`M${MARGIN.left},${this.y(y)}H${width - MARGIN.right}`));
    }
    for (const ratio of RATIOS) {
      const x = Math.min(this.mostX, this.mostY / ratio);
      c.setLineDash([3, 4]);
      c.strokeStyle = p.muted;
      c.stroke(new Path2D(`M${this.x(0)},${this.y(0)}L${this.x(x)},${this.y(x * ratio)}`));
      c.setLineDash([]);
      c.fillText(`× ${ratio}`, this.x(x) - 4, this.y(x * ratio) + 12);
    }
  }

  private click(event: MouseEvent): void {
    const away = ({mission}: {mission: Mission}) => {
      const [x, y] = this.place(mission);
      return Math.hypot(event.offsetX - x, event.offsetY - y);
    };
    const near = this.dots
      .filter((dot) => dot.replay >= 0 && away(dot) < 12)
      .sort((a, b) => away(a) - away(b));
    if (near.length > 0) location.hash = `run=${near[0].replay}`;
  }

  private place(mission: Mission): [number, number] {
    return [this.x(mission.shortest_m!), this.y(mission.path_m)];
  }
  private x(metres: number): number {
    return MARGIN.left + (metres / this.mostX) * (this.surface.width - MARGIN.left - MARGIN.right);
  }
  private y(metres: number): number {
    const bottom = this.surface.height - MARGIN.bottom;
    return bottom - (metres / this.mostY) * (bottom - MARGIN.top);
  }
}
