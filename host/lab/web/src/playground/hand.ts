/** Keys and joystick of the user who drives. */
import {element} from '../dom.ts';

/** By KeyboardEvent.code, so that W A S D are where they are on every keyboard: ahead and left. */
const KEYS: Record<string, [ahead: number, left: number]> = {
  ArrowUp: [1, 0],
  KeyW: [1, 0],
  ArrowDown: [-1, 0],
  KeyS: [-1, 0],
  ArrowLeft: [0, 1],
  KeyA: [0, 1],
  ArrowRight: [0, -1],
  KeyD: [0, -1],
};

/** Of the radius of the joystick: nearer to its middle, it asks for nothing. */
const DEAD = 0.12;

export interface Steered {
  /** Keys and joystick have an effect. */
  steers(): boolean;
  /** Ahead and to the left, -1 to 1. */
  ask(ahead: number, left: number): void;
}

export class Hand {
  private readonly held = new Set<string>();
  private readonly stick = element('stick');
  private pointer: number | null = null;

  constructor(private readonly steered: Steered) {
    document.addEventListener('keydown', (event) => this.press(event));
    document.addEventListener('keyup', (event) => {
      if (this.held.delete(event.code)) this.askKeys();
    });
    // A key that is let go elsewhere sends no event here.
    addEventListener('blur', () => this.release());
    document.addEventListener('visibilitychange', () => this.release());
    this.stick.addEventListener('pointerdown', (event) => {
      if (!steered.steers() || this.pointer !== null) return;
      event.preventDefault();
      this.pointer = event.pointerId;
      this.stick.setPointerCapture(event.pointerId);
      this.drag(event);
    });
    this.stick.addEventListener('pointermove', (event) => {
      if (event.pointerId === this.pointer) this.drag(event);
    });
    for (const type of ['pointerup', 'pointercancel'] as const) {
      this.stick.addEventListener(type, (event) => {
        if (event.pointerId === this.pointer) this.release();
      });
    }
  }

  /** Asks for nothing. */
  release(): void {
    this.held.clear();
    this.pointer = null;
    this.steered.ask(0, 0);
  }

  private press(event: KeyboardEvent): void {
    if (!KEYS[event.code] || !this.steered.steers()) return;
    if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented) return;
    if ((event.target as HTMLElement).closest('input, select, textarea, dialog')) return;
    event.preventDefault();
    if (event.repeat) return;
    this.held.add(event.code);
    this.askKeys();
  }

  private askKeys(): void {
    let [ahead, left] = [0, 0];
    for (const code of this.held) {
      ahead += KEYS[code][0];
      left += KEYS[code][1];
    }
    const most = (x: number) => Math.max(-1, Math.min(1, x));
    this.steered.ask(most(ahead), most(left));
  }

  private drag(event: PointerEvent): void {
    const box = this.stick.getBoundingClientRect();
    const radius = box.width / 2;
    let right = (event.clientX - box.left - radius) / radius;
    let up = -(event.clientY - box.top - radius) / radius;
    const length = Math.hypot(right, up);
    const scale = length < DEAD ? 0 : 1 / Math.max(1, length);
    [right, up] = [right * scale, up * scale];
    this.steered.ask(up, -right);
  }
}
