/** The part of the world that the view of a run must show. */
import type {Box} from './camera.ts';
import type {Point, Run, World} from './data.ts';

/** The whole path, start and goal, and the world around them up to their own extent, at least 4 m. */
export function sceneBox(run: Run): Box {
  const x = run.column('x_m');
  const y = run.column('y_m');
  const way: Point[] = [];
  for (let i = 0; i < run.ticks; i += 10) way.push([x[i], y[i]]);
  return sceneBoxOf(run.info.world, way, run.info.robot.radius);
}

/** The same for a world and the points of a path. */
export function sceneBoxOf(world: World, way: Point[], radius = 0): Box {
  const {start, goal, tolerance, bounds, discs, polygons, walls, movers} = world;
  const box = {left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity};
  const add = (x: number, y: number, r = 0) => {
    box.left = Math.min(box.left, x - r);
    box.right = Math.max(box.right, x + r);
    box.bottom = Math.min(box.bottom, y - r);
    box.top = Math.max(box.top, y + r);
  };
  for (const [x, y] of way) add(x, y, radius);
  add(start[0], start[1], 0.1);
  add(goal[0], goal[1], Math.max(tolerance, 0.1));
  // Of a large world only the part around the path.
  const around = Math.max(4, box.right - box.left, box.top - box.bottom);
  const limit = {
    left: box.left - around,
    right: box.right + around,
    bottom: box.bottom - around,
    top: box.top + around,
  };
  const addNear = (px: number, py: number, r = 0) => {
    add(
      Math.max(limit.left + r, Math.min(limit.right - r, px)),
      Math.max(limit.bottom + r, Math.min(limit.top - r, py)),
      r,
    );
  };
  if (bounds) {
    addNear(bounds[0], bounds[1]);
    addNear(bounds[2], bounds[3]);
  }
  for (const [dx, dy, r] of discs) addNear(dx, dy, Math.min(r, around));
  for (const {path, radius} of movers) for (const [px, py] of path) addNear(px, py, radius);
  for (const points of [...polygons, ...walls]) for (const [px, py] of points) addNear(px, py);
  return box;
}
