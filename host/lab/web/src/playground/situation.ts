/** A scenario as an object, and as the list of numbers of host/lab/play/flat.hpp. */
import type {Mover, Point, World} from '../data.ts';

export const NOISE_KEYS = [
  'range_sigma_m',
  'range_dropout',
  'range_false_clear',
  'wheel_scale_sigma',
  'heading_drift_deg_per_sqrt_m',
] as const;

export interface Situation {
  seed: number;
  timeLimit: number;
  world: World;
  /** In the order of NOISE_KEYS. */
  noise: number[];
}

function flatLines(lines: Point[][]): number[] {
  return [lines.length, ...lines.flatMap((points) => [points.length, ...points.flat()])];
}

export function flat({seed, timeLimit, world, noise}: Situation): number[] {
  const {start, goal, tolerance, bounds, discs, polygons, walls, movers} = world;
  return [
    seed,
    timeLimit,
    ...start,
    ...goal,
    tolerance,
    ...(bounds ? [1, ...bounds] : [0]),
    discs.length,
    ...discs.flat(),
    ...flatLines(polygons),
    ...flatLines(walls),
    movers.length,
    ...movers.flatMap((m) => [...m.center, m.radius, m.speed, m.path.length, ...m.path.flat()]),
    ...noise,
  ];
}

export function situationOf(list: ArrayLike<number>): Situation {
  let at = 0;
  const next = () => list[at++];
  const point = (): Point => [next(), next()];
  const many = <T>(one: () => T): T[] => {
    const length = next();
    if (!(length >= 0 && length <= list.length)) throw new RangeError('not the list of a situation');
    return Array.from({length}, one);
  };
  const seed = next();
  const timeLimit = next();
  const start = point();
  const goal = point();
  const tolerance = next();
  const bounds: World['bounds'] = next() > 0 ? [next(), next(), next(), next()] : null;
  const discs = many((): [number, number, number] => [next(), next(), next()]);
  const polygons = many(() => many(point));
  const walls = many(() => many(point));
  const movers = many((): Mover => ({
    center: point(),
    radius: next(),
    speed: next(),
    path: many(point),
  }));
  const noise = NOISE_KEYS.map(next);
  return {seed, timeLimit, noise, world: {start, goal, tolerance, bounds, discs, polygons, walls, movers}};
}
