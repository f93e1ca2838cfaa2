/** Plots of columns over time. */
import uPlot from 'uplot';
import {BEAMS, type Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {WayToGoal} from './goal.ts';
import type {Player} from './player.ts';
import type {Colour, Theme} from './theme.ts';

export interface Line {
  label: string;
  colour: Colour;
  values: () => ArrayLike<number | null>;
  dashed?: boolean;
}

export interface Plot {
  id: string;
  lines: Line[];
  range: [low: number, high: number];
  /** The scale ends here, up and down. */
  most: number;
  unit: string;
  /** The times of boundary following are shaded. */
  edges: boolean;
}

/** Seconds before and after the current tick that a zoomed plot shows. */
const BEFORE = 15;
const AFTER = 5;
const HEIGHT = 132;
const ZOOMS = ['zoom', 'zoom-goal', 'zoom-asked'];

function rangeOf(lines: Line[], most: number): [number, number] {
  let low = 0;
  let high = 0;
  for (const line of lines) {
    const values = line.values();
    for (let i = 0; i < values.length; ++i) {
      const value = values[i];
      if (value === null) continue;
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  low = Math.max(low, -most);
  high = Math.min(high, most);
  const air = 0.06 * (high - low) || 1;
  return [low < 0 ? low - air : 0, high + air];
}

export function plotOf(id: string, unit: string, lines: Line[], most = Infinity): Plot {
  return {id, lines, range: rangeOf(lines, most), most, unit, edges: id === 'plot-goal'};
}

/** Of a mission: the distance to the goal. */
export function goalPlot(run: Run, way: WayToGoal): Plot {
  const distance = run.info.inside ? 'distance to the goal' : 'true distance to the goal';
  return plotOf('plot-goal', 'm', [
    {label: distance, colour: 'accent', values: () => way.distance},
    {label: 'nearest so far', colour: 'goal', values: () => way.nearest, dashed: true},
  ]);
}

export class Plots {
  private readonly plots: {
    plot: Plot;
    chart: uPlot;
    head: HTMLElement;
    shade: HTMLElement;
    values: HTMLElement[];
  }[] = [];
  private readonly ranges: (number | null)[][] = BEAMS.map(() => []);
  private zoomed = false;

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly theme: Theme,
    own: Plot[],
  ) {
    const wheel = (side: 'left' | 'right'): Line[] => [
      {label: side, colour: side, values: () => run.column(`v_${side}_mps`)},
      {label: `${side}, commanded`, colour: side, values: () => run.column(`cmd_${side}_mps`), dashed: true},
    ];
    this.grow();
    const ranges = BEAMS.map((beam, i): Line => ({label: beam, colour: beam, values: () => this.ranges[i]}));
    const plots = [
      ...own,
      plotOf('plot-ranges', 'm', ranges),
      plotOf('plot-wheels', 'm/s', [...wheel('left'), ...wheel('right')]),
    ];
    for (const plot of plots) this.build(plot);
    for (const id of ZOOMS) {
      element(id).addEventListener('click', () => this.setZoomed(!this.zoomed));
    }
  }

  update(): void {
    const tick = this.player.tick;
    const now = this.run.t[tick];
    for (const {plot, chart, head, values} of this.plots) {
      const {min, max} = this.window(now);
      if (this.zoomed) chart.setScale('x', {min, max});
      // valToPos would still use the old scale: the chart applies a new one later.
      const at = ((now - min) / (max - min)) * (chart.bbox.width / uPlot.pxRatio);
      head.style.transform = `translateX(${at}px)`;
      plot.lines.forEach(({values: all}, i) => {
        const value = all()[tick] ?? null;
        const text = value === null ? 'lost' : `${value.toFixed(2)} ${plot.unit}`;
        if (values[i].textContent !== text) values[i].textContent = text;
      });
    }
  }

  /** The run has more ticks. */
  grow(): void {
    const {run} = this;
    this.ranges.forEach((values, beam) => {
      for (let tick = values.length; tick < run.ticks; ++tick) values.push(run.range(beam, tick));
    });
  }

  /** Draws the ticks that were added. */
  redraw(): void {
    for (const {plot, chart, shade} of this.plots) {
      plot.range = rangeOf(plot.lines, plot.most);
      shade.hidden = !this.isShaded(plot);
      chart.setData(this.data(plot));
    }
    this.update();
  }

  restyle(): void {
    for (const {plot, chart} of this.plots.splice(0)) {
      chart.destroy();
      this.build(plot);
    }
    this.update();
  }

  setZoomed(on: boolean): void {
    this.zoomed = on;
    for (const id of ZOOMS) {
      element(id).setAttribute('aria-pressed', String(on));
    }
    if (!on) {
      for (const {chart} of this.plots) chart.setScale('x', this.window(0));
    }
    this.update();
  }

  private window(now: number): {min: number; max: number} {
    const {t, ticks} = this.run;
    return this.zoomed ? {min: now - BEFORE, max: now + AFTER} : {min: t[0], max: t[ticks - 1]};
  }

  private isShaded(plot: Plot): boolean {
    return plot.edges && this.run.info.edges.length > 0;
  }

  private shadeEdges(u: uPlot): void {
    const {t, ticks, info} = this.run;
    const {left: first, top, width, height} = u.bbox;
    u.ctx.save();
    u.ctx.fillStyle = this.theme.palette.danger;
    u.ctx.globalAlpha = 0.14;
    for (const {hit, left} of info.edges) {
      const from = Math.max(first, u.valToPos(t[hit], 'x', true));
      const to = Math.min(first + width, u.valToPos(t[left ?? ticks - 1], 'x', true));
      if (to > from) u.ctx.fillRect(from, top, to - from, height);
    }
    u.ctx.restore();
  }

  private data(plot: Plot): uPlot.AlignedData {
    return [this.run.t, ...plot.lines.map(({values}) => values())] as uPlot.AlignedData;
  }

  private build(plot: Plot): void {
    const p = this.theme.palette;
    const host = element(plot.id);
    host.replaceChildren();
    const legend = document.createElement('p');
    legend.className = 'legend';
    const values = plot.lines.map(({label, colour, dashed}) => {
      const key = document.createElement('span');
      key.className = dashed ? 'key dashed' : 'key';
      key.style.setProperty('--key', p[colour]);
      const value = document.createElement('b');
      const item = document.createElement('span');
      item.append(key, ` ${label} `, value);
      legend.append(item);
      return value;
    });
    const axis: uPlot.Axis = {
      stroke: p.muted,
      font: '11px Inter, system-ui, sans-serif',
      grid: {stroke: p.grid, width: 1},
      ticks: {stroke: p.line, width: 1, size: 4},
    };
    const chart = new uPlot(
      {
        width: Math.max(200, host.clientWidth),
        height: HEIGHT,
        padding: [6, 20, 0, 0],
        legend: {show: false},
        cursor: {show: false},
        scales: {
          x: {time: false, range: (_, min, max) => [min, max]},
          y: {range: () => plot.range},
        },
        axes: [
          {...axis, size: 26, space: 60, values: (_, splits) => splits.map((s) => `${s} s`)},
          {...axis, size: 44, space: 26},
        ],
        hooks: plot.edges ? {drawClear: [(u) => this.shadeEdges(u)]} : {},
        series: [
          {},
          ...plot.lines.map(({colour, dashed}) => ({
            stroke: p[colour],
            width: dashed ? 1.25 : 1.5,
            dash: dashed ? [4, 4] : undefined,
            points: {show: false},
            spanGaps: false,
          })),
        ],
      },
      this.data(plot),
      host,
    );
    const shade = make('span', '', [make('span', 'key shade'), document.createTextNode(' on a boundary')]);
    shade.hidden = !this.isShaded(plot);
    legend.append(shade);
    host.append(legend);
    const head = document.createElement('div');
    head.className = 'playhead';
    chart.over.append(head);
    chart.over.addEventListener('pointerdown', (event) => {
      this.player.seekTime(chart.posToVal(event.offsetX, 'x'));
    });
    this.plots.push({plot, chart, head, shade, values});
    new ResizeObserver(() => {
      const width = Math.max(200, host.clientWidth);
      if (width === chart.width || !host.contains(chart.root)) return;
      chart.setSize({width, height: HEIGHT});
      this.update();
    }).observe(host);
    setText(`${plot.id}-about`, plot.lines.map(({label}) => label).join(', '));
  }
}
