/** One output of the response table as a heat map, with the cell in use and the rules behind it. */
import {blend, rgb, type Rgb} from './colour.ts';
import type {Controller} from './data.ts';
import {Surface} from './dom.ts';
import type {FiredRule} from './rules.ts';
import type {Palette} from './theme.ts';

const MARGIN = {left: 30, right: 8, top: 6, bottom: 30};

/** The last input of the table. */
export interface Question {
  d: number;
  r: number;
  /** The cell of the engine's grid. */
  cellD: number;
  cellR: number;
  rules: FiredRule[];
  /** The answer steers at this tick. */
  inUse: boolean;
}

/** D goes up. R goes to the left, so that an obstacle on the left is on the left. */
export class HeatMap {
  private readonly surface: Surface;
  private image: HTMLCanvasElement | null = null;
  private question: Question | null = null;
  private palette: Palette;

  constructor(
    canvas: HTMLCanvasElement,
    private readonly controller: Controller,
    private readonly thousandths: number[],
    private readonly range: () => [low: number, high: number],
    private readonly stops: (palette: Palette) => string[],
    palette: Palette,
  ) {
    this.palette = palette;
    this.surface = new Surface(canvas, () => this.draw());
  }

  restyle(palette: Palette): void {
    this.palette = palette;
    this.image = null;
    this.draw();
  }

  show(question: Question | null): void {
    this.question = question;
    this.draw();
  }

  private x(r: number): number {
    const {min, max} = this.controller.r;
    return MARGIN.left + ((max - r) / (max - min)) * (this.surface.width - MARGIN.left - MARGIN.right);
  }
  private y(d: number): number {
    const {min, max} = this.controller.d;
    return MARGIN.top + ((max - d) / (max - min)) * (this.surface.height - MARGIN.top - MARGIN.bottom);
  }

  private colours(): HTMLCanvasElement {
    if (this.image) return this.image;
    const {d, r, samples_per_unit: samples} = this.controller;
    const width = Math.round((r.max - r.min) * samples) + 1;
    const height = Math.round((d.max - d.min) * samples) + 1;
    const image = document.createElement('canvas');
    image.width = width;
    image.height = height;
    const context = image.getContext('2d')!;
    const pixels = context.createImageData(width, height);
    const stops: Rgb[] = this.stops(this.palette).map(rgb);
    const [low, high] = this.range();
    this.thousandths.forEach((value, i) => {
      const row = height - 1 - Math.floor(i / width);
      const column = width - 1 - (i % width);
      const k = (value / 1000 - low) / (high - low);
      pixels.data.set([...blend(stops, k), 255], 4 * (row * width + column));
    });
    context.putImageData(pixels, 0, 0);
    return (this.image = image);
  }

  private draw(): void {
    const {surface, palette: p} = this;
    const {d, r} = this.controller;
    const c = surface.clear();
    if (surface.width < 80 || surface.height < 80) return;
    const [left, right, top, bottom] = [this.x(r.max), this.x(r.min), this.y(d.max), this.y(d.min)];
    c.imageSmoothingEnabled = true;
    c.imageSmoothingQuality = 'high';
    c.globalAlpha = this.question && !this.question.inUse ? 0.55 : 1;
    c.drawImage(this.colours(), left, top, right - left, bottom - top);
    c.globalAlpha = 1;
    c.strokeStyle = p.line;
    c.lineWidth = 1;
    c.strokeRect(left, top, right - left, bottom - top);
    this.drawTerms(c);
    if (this.question) this.drawQuestion(c, this.question);
  }

  private drawTerms(c: CanvasRenderingContext2D): void {
    const {palette: p, surface} = this;
    const {d, r} = this.controller;
    const small = surface.width < 190;
    c.fillStyle = p.muted;
    c.font = `${small ? 9 : 10}px Inter, system-ui, sans-serif`;
    c.textBaseline = 'middle';
    c.textAlign = 'right';
    for (const [name, centre] of d.terms) c.fillText(name, MARGIN.left - 5, this.y(centre));
    c.textAlign = 'center';
    for (const [name, centre] of r.terms) c.fillText(name, this.x(centre), this.y(d.min) + 8);
    c.textBaseline = 'bottom';
    c.textAlign = 'left';
    c.fillText('left nearer', this.x(r.max), surface.height);
    c.textAlign = 'right';
    c.fillText('right nearer', this.x(r.min), surface.height);
  }

  private drawQuestion(c: CanvasRenderingContext2D, q: Question): void {
    const {palette: p} = this;
    const {d, r, d_nodes, r_nodes} = this.controller;
    for (const rule of q.rules) {
      c.beginPath();
      c.arc(this.x(r.terms[rule.r][1]), this.y(d.terms[rule.d][1]), 3 + 8 * rule.weight, 0, 2 * Math.PI);
      c.lineWidth = 3;
      c.strokeStyle = p.panel;
      c.stroke();
      c.lineWidth = 1.5;
      c.strokeStyle = p.ink;
      c.stroke();
    }
    const x0 = this.x(r_nodes[q.cellR + 1]);
    const x1 = this.x(r_nodes[q.cellR]);
    const y0 = this.y(d_nodes[q.cellD + 1]);
    const y1 = this.y(d_nodes[q.cellD]);
    c.lineWidth = 4;
    c.strokeStyle = p.panel;
    c.strokeRect(x0 - 1, y0 - 1, x1 - x0 + 2, y1 - y0 + 2);
    c.lineWidth = 2;
    c.strokeStyle = p.ink;
    c.strokeRect(x0 - 1, y0 - 1, x1 - x0 + 2, y1 - y0 + 2);
    const x = this.x(Math.max(r.min, Math.min(r.max, q.r)));
    const y = this.y(Math.max(d.min, Math.min(d.max, q.d)));
    c.lineWidth = 1;
    c.globalAlpha = q.inUse ? 0.8 : 0.35;
    c.beginPath();
    c.moveTo(x, this.y(d.max));
    c.lineTo(x, this.y(d.min));
    c.moveTo(this.x(r.max), y);
    c.lineTo(this.x(r.min), y);
    c.stroke();
    c.globalAlpha = 1;
  }
}
