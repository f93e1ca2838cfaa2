/** The objects of a world that the user can edit: find, move, resize, remove. Each function returns a new world. */
import type {Point, World} from '../data.ts';

export type Thing =
  {kind: 'start'} | {kind: 'goal'} | {kind: 'disc' | 'polygon' | 'wall' | 'mover'; index: number};

export function same(a: Thing | null, b: Thing | null): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}

export function thingsOf(world: World): Thing[] {
  const of = (kind: 'disc' | 'polygon' | 'wall' | 'mover', list: unknown[]): Thing[] =>
    list.map((_, index) => ({kind, index}));
  return [
    {kind: 'goal'},
    {kind: 'start'},
    ...of('disc', world.discs),
    ...of('polygon', world.polygons),
    ...of('wall', world.walls),
    ...of('mover', world.movers),
  ];
}

function distanceToSegment([px, py]: Point, [ax, ay]: Point, [bx, by]: Point): number {
  const [dx, dy] = [bx - ax, by - ay];
  const square = dx * dx + dy * dy;
  const k = square > 0 ? Math.max(0, Math.min(1, ((px - ax) * dx + (py - ay) * dy) / square)) : 0;
  return Math.hypot(px - ax - k * dx, py - ay - k * dy);
}

function distanceToLine(at: Point, points: Point[], closed: boolean): number {
  let least = Infinity;
  for (let i = closed ? 0 : 1; i < points.length; ++i) {
    least = Math.min(least, distanceToSegment(at, points.at(i - 1)!, points[i]));
  }
  return least;
}

function inside([x, y]: Point, points: Point[]): boolean {
  let odd = false;
  points.forEach(([bx, by], i) => {
    const [ax, ay] = points.at(i - 1)!;
    if (ay > y !== by > y && x < ax + ((bx - ax) * (y - ay)) / (by - ay)) odd = !odd;
  });
  return odd;
}

/** The distance from a place to an object's surface; negative inside it. */
export function distanceTo(world: World, thing: Thing, at: Point): number {
  const from = ([x, y]: Point) => Math.hypot(x - at[0], y - at[1]);
  switch (thing.kind) {
    case 'start':
      return from(world.start);
    case 'goal':
      return from(world.goal) - world.tolerance;
    case 'disc': {
      const [x, y, radius] = world.discs[thing.index];
      return from([x, y]) - radius;
    }
    case 'polygon': {
      const points = world.polygons[thing.index];
      const outline = distanceToLine(at, points, true);
      return inside(at, points) ? -outline : outline;
    }
    case 'wall':
      return distanceToLine(at, world.walls[thing.index], false);
    case 'mover':
      return from(world.movers[thing.index].center) - world.movers[thing.index].radius;
  }
}

/** The object at a place, or within `reach` metres; small objects come first. */
export function thingAt(world: World, at: Point, reach: number): Thing | null {
  let best: Thing | null = null;
  let least = Infinity;
  for (const thing of thingsOf(world)) {
    const solid = thing.kind === 'disc' || thing.kind === 'polygon';
    const distance = distanceTo(world, thing, at);
    if (distance > (solid ? reach / 2 : reach)) continue;
    const rank = Math.max(distance, 0) + (solid ? reach : 0);
    if (rank < least) [best, least] = [thing, rank];
  }
  return best;
}

/** Rounds to millimetres, so that page and file hold the same number. 0 has no sign, because a link would lose it. */
export function tidy(x: number): number {
  return Math.round(x * 1000) / 1000 + 0;
}

export function moved(world: World, thing: Thing, dx: number, dy: number): World {
  const by = ([x, y]: Point): Point => [tidy(x + dx), tidy(y + dy)];
  const at = <T>(list: T[], index: number, change: (item: T) => T): T[] =>
    list.map((item, i) => (i === index ? change(item) : item));
  switch (thing.kind) {
    case 'start':
      return {...world, start: by(world.start)};
    case 'goal':
      return {...world, goal: by(world.goal)};
    case 'disc':
      return {...world, discs: at(world.discs, thing.index, ([x, y, r]) => [...by([x, y]), r])};
    case 'polygon':
      return {...world, polygons: at(world.polygons, thing.index, (points) => points.map(by))};
    case 'wall':
      return {...world, walls: at(world.walls, thing.index, (points) => points.map(by))};
    case 'mover':
      return {
        ...world,
        movers: at(world.movers, thing.index, (m) => ({...m, center: by(m.center), path: m.path.map(by)})),
      };
  }
}

export function sized(world: World, thing: Thing, factor: number): World {
  const next = (radius: number) => tidy(Math.max(0.01, Math.min(5, radius * factor)));
  if (thing.kind === 'disc') {
    return {
      ...world,
      discs: world.discs.map(([x, y, r], i) => (i === thing.index ? [x, y, next(r)] : [x, y, r])),
    };
  }
  if (thing.kind !== 'polygon' && thing.kind !== 'wall') return world;
  const grown = (points: Point[]): Point[] => {
    const middle = (k: 0 | 1) => points.reduce((sum, p) => sum + p[k], 0) / points.length;
    const [mx, my] = [middle(0), middle(1)];
    return points.map(([x, y]) => [tidy(mx + (x - mx) * factor), tidy(my + (y - my) * factor)]);
  };
  const change = (list: Point[][]) => list.map((points, i) => (i === thing.index ? grown(points) : points));
  return thing.kind === 'polygon'
    ? {...world, polygons: change(world.polygons)}
    : {...world, walls: change(world.walls)};
}

/** Start and goal stay. */
export function without(world: World, thing: Thing): World {
  const but = <T>(list: T[], index: number): T[] => list.filter((_, i) => i !== index);
  switch (thing.kind) {
    case 'disc':
      return {...world, discs: but(world.discs, thing.index)};
    case 'polygon':
      return {...world, polygons: but(world.polygons, thing.index)};
    case 'wall':
      return {...world, walls: but(world.walls, thing.index)};
    case 'mover':
      return {...world, movers: but(world.movers, thing.index)};
    default:
      return world;
  }
}

export const NEW_KINDS = ['disc', 'bar', 'wall', 'mover'] as const;
export type NewKind = (typeof NEW_KINDS)[number];

/** The world with one more object, and that object. */
export function withNew(world: World, kind: NewKind, [px, py]: Point): [World, Thing] {
  const [x, y] = [tidy(px), tidy(py)];
  switch (kind) {
    case 'disc':
      return [
        {...world, discs: [...world.discs, [x, y, 0.3]]},
        {kind: 'disc', index: world.discs.length},
      ];
    case 'bar': {
      const corners: Point[] = [
        [-0.6, -0.05],
        [0.6, -0.05],
        [0.6, 0.05],
        [-0.6, 0.05],
      ];
      const bar = corners.map(([dx, dy]): Point => [tidy(x + dx), tidy(y + dy)]);
      return [
        {...world, polygons: [...world.polygons, bar]},
        {kind: 'polygon', index: world.polygons.length},
      ];
    }
    case 'wall': {
      const wall: Point[] = [
        [x, tidy(y - 0.6)],
        [x, tidy(y + 0.6)],
      ];
      return [
        {...world, walls: [...world.walls, wall]},
        {kind: 'wall', index: world.walls.length},
      ];
    }
    case 'mover': {
      const path: Point[] = [
        [tidy(x - 1), y],
        [tidy(x + 1), y],
      ];
      const mover = {center: path[0], radius: 0.12, path, speed: 0.1};
      return [
        {...world, movers: [...world.movers, mover]},
        {kind: 'mover', index: world.movers.length},
      ];
    }
  }
}

export function nameOf(world: World, thing: Thing): string {
  if (thing.kind === 'start' || thing.kind === 'goal') {
    const [x, y] = world[thing.kind];
    return `${thing.kind} at ${x.toFixed(2)}, ${y.toFixed(2)}`;
  }
  const place = {
    disc: () => world.discs[thing.index],
    polygon: () => world.polygons[thing.index][0],
    wall: () => world.walls[thing.index][0],
    mover: () => world.movers[thing.index].center,
  }[thing.kind]();
  return `${thing.kind} ${thing.index + 1} at ${place[0].toFixed(2)}, ${place[1].toFixed(2)}`;
}
