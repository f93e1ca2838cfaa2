/** Lines of the world, simplified within what is visible. */
import type {Mover, Point, Run} from './data.ts';

/** A piece of the path in one class; neighbours share a point. */
export interface Piece {
  kind: number;
  ticks: number[];
  path: Path2D;
}

function distanceToSegment(px: number, py: number, ax: number, ay: number, bx: number, by: number): number {
  const dx = bx - ax;
  const dy = by - ay;
  const square = dx * dx + dy * dy;
  const k = square > 0 ? Math.max(0, Math.min(1, ((px - ax) * dx + (py - ay) * dy) / square)) : 0;
  return Math.hypot(px - ax - k * dx, py - ay - k * dy);
}

/** Ramer, Douglas and Peucker: the ticks of [from, to] that are kept, without `from`. */
function simplified(x: Float64Array, y: Float64Array, from: number, to: number, tolerance: number): number[] {
  const kept: number[] = [];
  const open: [number, number][] = [[from, to]];
  while (open.length > 0) {
    const [a, b] = open.pop()!;
    let split = -1;
    let farthest = tolerance;
    for (let i = a + 1; i < b; ++i) {
      const d = distanceToSegment(x[i], y[i], x[a], y[a], x[b], y[b]);
      if (d > farthest) {
        farthest = d;
        split = i;
      }
    }
    if (split < 0) kept.push(b);
    else open.push([split, b], [a, split]);
  }
  return kept;
}

/** At most this many ticks are simplified at once, which bounds the work for a long path. */
const CHUNK = 400;

/** The pieces from this tick on, at which a piece must begin. `classes` is the column with the class of each tick. */
export function pathPieces(run: Run, classes: string, first = 0, tolerance = 0.002): Piece[] {
  const x = run.column('x_m');
  const y = run.column('y_m');
  const kinds = run.column(classes);
  const pieces: Piece[] = [];
  for (let from = first; from < run.ticks - 1;) {
    let to = from + 1;
    while (to < run.ticks - 1 && to - from < CHUNK && kinds[to + 1] === kinds[from + 1]) ++to;
    const ticks = [from, ...simplified(x, y, from, to, tolerance)];
    const path = new Path2D();
    ticks.forEach((tick, i) => (i === 0 ? path.moveTo(x[tick], y[tick]) : path.lineTo(x[tick], y[tick])));
    pieces.push({kind: kinds[from + 1], ticks, path});
    from = to;
  }
  return pieces;
}

export function polyline(points: Point[], closed = false): Path2D {
  const path = new Path2D();
  points.forEach(([x, y], i) => (i === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  if (closed) path.closePath();
  return path;
}

/** The place of a mover: it drives from its centre to the end of its path, back, and again. */
export function moverPosition({path, center, speed}: Mover, time: number): Point {
  const at = [0];
  let start = 0;
  let nearest = Infinity;
  for (let i = 1; i < path.length; ++i) {
    const [ax, ay] = path[i - 1];
    const [bx, by] = path[i];
    const length = Math.hypot(bx - ax, by - ay);
    const d = distanceToSegment(center[0], center[1], ax, ay, bx, by);
    if (d < nearest && length > 0) {
      nearest = d;
      const along = ((center[0] - ax) * (bx - ax) + (center[1] - ay) * (by - ay)) / length;
      start = at[i - 1] + Math.max(0, Math.min(length, along));
    }
    at.push(at[i - 1] + length);
  }
  const total = at[at.length - 1];
  if (!(total > 0)) return center;
  const lap = (start + speed * time) % (2 * total);
  const s = lap <= total ? lap : 2 * total - lap;
  for (let i = 1; i < path.length; ++i) {
    const length = at[i] - at[i - 1];
    if (s > at[i] || length === 0) continue;
    const k = (s - at[i - 1]) / length;
    return [
      path[i - 1][0] + k * (path[i][0] - path[i - 1][0]),
      path[i - 1][1] + k * (path[i][1] - path[i - 1][1]),
    ];
  }
  return path[path.length - 1];
}
