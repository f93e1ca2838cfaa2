/** Wheel, mouse and fingers on a canvas. */

export interface Hands {
  /** Zooms about this place of the canvas, in pixels. */
  zoom(factor: number, x: number, y: number): void;
  /** Moves by this many pixels, x to the right, y down. */
  pan(dx: number, dy: number): void;
  /** False: one finger scrolls the page. */
  oneFingerPans(): boolean;
}

const WHEEL_ZOOM = 0.0015;

export function listenToHands(canvas: HTMLCanvasElement, hands: Hands): void {
  const pointers = new Map<number, [x: number, y: number]>();

  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      hands.zoom(Math.exp(-event.deltaY * WHEEL_ZOOM), event.offsetX, event.offsetY);
    },
    {passive: false},
  );
  canvas.addEventListener('pointerdown', (event) => {
    pointers.set(event.pointerId, [event.offsetX, event.offsetY]);
    if (event.pointerType === 'mouse') canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now: [number, number] = [event.offsetX, event.offsetY];
    pointers.set(event.pointerId, now);
    const other = [...pointers].find(([id]) => id !== event.pointerId);
    if (other) {
      const [x, y] = other[1];
      const span = (p: [number, number]) => Math.max(1, Math.hypot(p[0] - x, p[1] - y));
      hands.zoom(span(now) / span(before), (now[0] + x) / 2, (now[1] + y) / 2);
    } else if (event.pointerType !== 'touch' || hands.oneFingerPans()) {
      hands.pan(now[0] - before[0], now[1] - before[1]);
    }
  });
  for (const type of ['pointerup', 'pointercancel'] as const) {
    canvas.addEventListener(type, (event) => pointers.delete(event.pointerId));
  }
}
