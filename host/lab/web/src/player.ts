/** The current tick, and playback. */
import type {Run} from './data.ts';

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];

/** The initial speed plays a run in at most about this many seconds. */
const LONGEST_SHOW = 60;

export class Player {
  tick = 0;
  playing = false;
  speed = 1;
  /** More ticks may come. */
  live = false;
  /** Stays at the newest tick. */
  following = false;
  private time = 0;
  private last = 0;
  private pending = false;
  private readonly listeners: (() => void)[] = [];

  constructor(readonly run: Run) {
    const seconds = run.t[run.ticks - 1];
    this.speed = SPEEDS.find((speed) => speed >= 1 && seconds / speed <= LONGEST_SHOW) ?? 16;
  }

  /** Called at most once a frame, after the tick, the speed or playing has changed. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  get end(): number {
    return this.run.ticks - 1;
  }

  /** A seek to the newest tick of a live run follows it. */
  seek(tick: number): void {
    this.tick = Math.max(0, Math.min(this.end, Math.round(tick)));
    this.following = this.live && this.tick === this.end;
    this.time = this.run.t[this.tick];
    this.request();
  }

  seekTime(time: number): void {
    this.seek(this.run.tickAt(time));
  }

  /** The run has more ticks. */
  grow(): void {
    if (this.following) this.seek(this.end);
    else this.request();
  }

  /** No more ticks follow. */
  stopLive(): void {
    this.live = this.following = false;
    this.request();
  }

  play(): void {
    if (this.tick === this.end) {
      this.seek(this.live ? this.end : 0);
      if (this.following) return;
    }
    this.playing = true;
    this.last = performance.now();
    this.request();
  }

  pause(): void {
    this.playing = this.following = false;
    this.request();
  }

  toggle(): void {
    if (this.playing || this.following) this.pause();
    else this.play();
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.request();
  }

  /** The next slower or faster of SPEEDS. */
  shiftSpeed(by: number): void {
    const at = SPEEDS.indexOf(this.speed) + by;
    this.setSpeed(SPEEDS[Math.max(0, Math.min(SPEEDS.length - 1, at))]);
  }

  /** Draw again soon. */
  request(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  private frame(now: number): void {
    this.pending = false;
    if (this.playing) {
      // A hidden page gets no frames; it continues from the same tick.
      this.time += Math.min(0.1, Math.max(0, (now - this.last) / 1000)) * this.speed;
      this.last = now;
      this.tick = this.run.tickAt(this.time);
      if (this.tick === this.end) {
        this.playing = false;
        this.following = this.live;
      }
    }
    for (const listener of this.listeners) listener();
    if (this.playing) this.request();
  }
}
