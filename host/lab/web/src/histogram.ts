/** The distribution of a figure over the missions. */
import {make} from './dom.ts';

const SVG = 'http://www.w3.org/2000/svg';
const WIDTH = 320;
const HEIGHT = 120;
const BASE = HEIGHT - 18;
const BINS = 24;

function svg(name: string, attributes: Record<string, string | number>): SVGElement {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, String(value));
  return node;
}

/** 1, 2 or 5 times a power of ten, so that at most `most` of them make up `span`. */
export function roundStep(span: number, most: number): number {
  const least = span / most;
  const ten = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((k) => k * ten).find((step) => step >= least * 0.999)!;
}

export function quantile(sorted: number[], p: number): number {
  return sorted[Math.max(0, Math.ceil(p * sorted.length) - 1)];
}

export interface Spread {
  title: string;
  unit: string;
  values: number[];
  /** The bins begin here, or at a smaller value. */
  from: number;
  /** The far end of the bad side: 0.95, or 0.05 where small is bad. */
  tail: 0.05 | 0.95;
}

export function histogram({title, unit, values, from, tail}: Spread): HTMLElement {
  const figure = make('figure', 'histogram', [make('figcaption', '', title)]);
  if (values.length === 0) {
    figure.append(make('p', 'muted', 'no mission reports the goal as reached'));
    return figure;
  }
  const sorted = [...values].sort((a, b) => a - b);
  const low = Math.min(from, sorted[0]);
  const step = roundStep(Math.max(1e-6, sorted[sorted.length - 1] - low), BINS);
  const first = Math.floor(low / step + 1e-9) * step;
  const bins = Math.max(1, Math.floor((sorted[sorted.length - 1] - first) / step + 1e-9) + 1);
  const counts = new Array<number>(bins).fill(0);
  for (const value of sorted) ++counts[Math.min(bins - 1, Math.floor((value - first) / step + 1e-9))];
  const most = Math.max(...counts);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const p50 = quantile(sorted, 0.5);
  const worst = quantile(sorted, tail);
  const withUnit = (value: number, extra: number) =>
    `${value.toFixed(digits + extra)}${unit ? ` ${unit}` : ''}`;
  const words = `median ${withUnit(p50, 1)}, 95 % ${tail > 0.5 ? 'at most' : 'at least'} ${withUnit(worst, 1)}`;

  const picture = svg('svg', {
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    role: 'img',
    'aria-label': `${title}: ${words}`,
  });
  const x = (value: number) => ((value - first) / (bins * step)) * WIDTH;
  counts.forEach((count, i) => {
    if (count === 0) return;
    const height = Math.max(1.5, (count / most) * (BASE - 6));
    const bar = svg('rect', {
      x: x(first + i * step) + 0.5,
      y: BASE - height,
      width: Math.max(1, WIDTH / bins - 1),
      height,
      class: 'bin',
    });
    const name = svg('title', {});
    name.textContent = `${(first + i * step).toFixed(digits)} to ${(first + (i + 1) * step).toFixed(digits)}: ${count}`;
    bar.append(name);
    picture.append(bar);
  });
  for (const [value, style] of [
    [p50, 'median'],
    [worst, 'tail'],
  ] as const) {
    picture.append(svg('line', {x1: x(value), x2: x(value), y1: 0, y2: BASE, class: style}));
  }
  picture.append(svg('line', {x1: 0, x2: WIDTH, y1: BASE, y2: BASE, class: 'base'}));
  const label = (value: number, anchor: string) => {
    const text = svg('text', {x: x(value), y: HEIGHT - 4, 'text-anchor': anchor});
    text.textContent = withUnit(value, 0);
    picture.append(text);
  };
  label(first, 'start');
  label(first + bins * step, 'end');
  figure.append(picture, make('p', 'muted', words));
  return figure;
}
