/** A scenario file, as docs/scenario.md describes it. */
import type {Point} from '../data.ts';
import {NOISE_KEYS, type Situation} from './situation.ts';

/** The shortest decimal that reads back as the same number. */
function number(x: number): string {
  const text = Object.is(x, -0) ? '-0' : String(x);
  return /[.e]/.test(text) ? text : `${text}.0`;
}

function point([x, y]: Point): string {
  return `[${number(x)}, ${number(y)}]`;
}

function points(list: Point[]): string {
  return `[${list.map(point).join(', ')}]`;
}

/** `parameters`: lines for the robot. */
export function scenarioToml(
  name: string,
  {seed, timeLimit, world, noise}: Situation,
  parameters: string[] = [],
): string {
  const {start, goal, tolerance, bounds, discs, polygons, walls, movers} = world;
  const parts = [
    `name = ${JSON.stringify(name)}\nseed = ${seed}  # of the noise\ntime_limit_s = ${number(timeLimit)}`,
    `[start]\nx_m = ${number(start[0])}\ny_m = ${number(start[1])}\n# heading_deg: towards the goal`,
    `[goal]\nx_m = ${number(goal[0])}\ny_m = ${number(goal[1])}\ntolerance_m = ${number(tolerance)}`,
  ];
  if (bounds) {
    const [left, bottom, right, top] = bounds;
    parts.push(`[bounds]  # solid outer wall\nmin = ${point([left, bottom])}\nmax = ${point([right, top])}`);
  }
  for (const [x, y, radius] of discs) {
    parts.push(`[[disc]]\ncenter = ${point([x, y])}\nradius_m = ${number(radius)}`);
  }
  for (const list of polygons) parts.push(`[[polygon]]  # solid\npoints = ${points(list)}`);
  for (const list of walls) parts.push(`[[wall]]  # zero thickness\npoints = ${points(list)}`);
  for (const {center, radius, path, speed} of movers) {
    parts.push(
      `[[mover]]  # there and back along its path\ncenter = ${point(center)}\nradius_m = ${number(radius)}\n` +
        `path = ${points(path)}\nspeed_mps = ${number(speed)}`,
    );
  }
  const disturbed = NOISE_KEYS.flatMap((key, i) => (noise[i] !== 0 ? [`${key} = ${number(noise[i])}`] : []));
  if (disturbed.length > 0) parts.push(`[noise]\n${disturbed.join('\n')}`);
  if (parameters.length > 0) parts.push(`[robot]\n${parameters.join('\n')}`);
  return `${parts.join('\n\n')}\n`;
}
