/** Ground, grid, the straight line to the goal, and the scale. */
import type {Camera} from './camera.ts';
import type {World} from './data.ts';
import type {Surface} from './dom.ts';
import type {Palette} from './theme.ts';

/** Before the camera is applied. */
export function drawGround(
  c: CanvasRenderingContext2D,
  p: Palette,
  camera: Camera,
  {width, height}: Surface,
  bounds: World['bounds'],
): void {
  c.fillStyle = bounds ? p.outside : p.ground;
  c.fillRect(0, 0, width, height);
  if (!bounds) return;
  const [left, bottom] = camera.toScreen(bounds[0], bounds[1], width, height);
  const [right, top] = camera.toScreen(bounds[2], bounds[3], width, height);
  c.fillStyle = p.ground;
  c.fillRect(left, top, right - left, bottom - top);
}

/** Metres between two lines of the grid; also the length of the scale. */
function stepOf(camera: Camera): number {
  return camera.scale > 150 ? 0.5 : camera.scale > 20 ? 1 : 10;
}

export function drawGrid(c: CanvasRenderingContext2D, p: Palette, camera: Camera, surface: Surface): void {
  const pixel = 1 / camera.scale;
  const halfX = (surface.width / 2) * pixel;
  const halfY = (surface.height / 2) * pixel;
  const step = stepOf(camera);
  c.strokeStyle = p.grid;
  c.lineWidth = pixel;
  c.beginPath();
  for (let x = Math.ceil((camera.x - halfX) / step) * step; x <= camera.x + halfX; x += step) {
    c.moveTo(x, camera.y - halfY);
    c.lineTo(x, camera.y + halfY);
  }
  for (let y = Math.ceil((camera.y - halfY) / step) * step; y <= camera.y + halfY; y += step) {
    c.moveTo(camera.x - halfX, y);
    c.lineTo(camera.x + halfX, y);
  }
  c.stroke();
}

export function drawLineToGoal(
  c: CanvasRenderingContext2D,
  p: Palette,
  pixel: number,
  {start, goal}: World,
): void {
  c.strokeStyle = p.muted;
  c.globalAlpha = 0.6;
  c.lineWidth = pixel;
  c.setLineDash([pixel, 5 * pixel]);
  c.beginPath();
  c.moveTo(start[0], start[1]);
  c.lineTo(goal[0], goal[1]);
  c.stroke();
  c.setLineDash([]);
  c.globalAlpha = 1;
}

/** In pixels, in the lower right corner. */
export function drawScaleBar(
  c: CanvasRenderingContext2D,
  p: Palette,
  camera: Camera,
  surface: Surface,
): void {
  const step = stepOf(camera);
  const length = step * camera.scale;
  const x = surface.width - 14 - length;
  const y = surface.height - 12;
  c.strokeStyle = c.fillStyle = p.muted;
  c.lineWidth = 1.5;
  c.stroke(new Path2D(`M${x},${y - 4}v4h${length}v-4`));
  c.font = '11px Inter, system-ui, sans-serif';
  c.textAlign = 'center';
  c.textBaseline = 'bottom';
  c.fillText(`${step} m`, x + length / 2, y - 3);
}
