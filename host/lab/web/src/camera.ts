/** The part of the world that a canvas shows: y is up. */

export interface Box {
  left: number;
  bottom: number;
  right: number;
  top: number;
}

export class Camera {
  x = 0;
  y = 0;
  /** Pixels a metre. */
  scale = 100;
  /** The world is turned by this, counter-clockwise, before it is drawn. */
  turn = 0;

  /** Metres to pixels of a canvas of this size. */
  apply(context: CanvasRenderingContext2D, width: number, height: number): void {
    context.translate(width / 2, height / 2);
    context.scale(this.scale, -this.scale);
    context.rotate(this.turn);
    context.translate(-this.x, -this.y);
  }

  toScreen(x: number, y: number, width: number, height: number): [number, number] {
    const dx = x - this.x;
    const dy = y - this.y;
    const cos = Math.cos(this.turn);
    const sin = Math.sin(this.turn);
    return [width / 2 + this.scale * (dx * cos - dy * sin), height / 2 - this.scale * (dx * sin + dy * cos)];
  }

  /** For a camera that is not turned. */
  toWorld(px: number, py: number, width: number, height: number): [number, number] {
    return [this.x + (px - width / 2) / this.scale, this.y - (py - height / 2) / this.scale];
  }

  /** Zooms about this place of a canvas of this size; for a camera that is not turned. */
  zoom(factor: number, px: number, py: number, width: number, height: number): void {
    const [x, y] = this.toWorld(px, py, width, height);
    const scale = Math.max(4, Math.min(2000, this.scale * factor));
    this.x = x + ((this.x - x) * this.scale) / scale;
    this.y = y + ((this.y - y) * this.scale) / scale;
    this.scale = scale;
  }

  fit(box: Box, width: number, height: number, margin: number): void {
    this.x = (box.left + box.right) / 2;
    this.y = (box.bottom + box.top) / 2;
    this.scale = Math.max(
      1,
      Math.min((width - 2 * margin) / (box.right - box.left), (height - 2 * margin) / (box.top - box.bottom)),
    );
  }
}
