/** What each tick of a drive of the guard asked for and got. */
import type {GuardInfo, Run} from './data.ts';
import {BARE, REASONS, type Velocity} from './guard_words.ts';
import type {Colour} from './theme.ts';

/** Scales end here, times what the wheels can do: a malicious command may be far beyond. */
const MOST = 1.3;

export class Grants {
  readonly info: GuardInfo;
  /** m/s and rad/s. */
  readonly asked: {forward: Float64Array; turning: Float64Array};
  readonly granted: {forward: Float64Array; turning: Float64Array};
  /** Granted shares, 0 to 1. */
  readonly share: {forward: Float64Array; turning: Float64Array};
  readonly driven: {forward: Float64Array; turning: Float64Array};

  constructor(private readonly run: Run) {
    this.info = run.info.guard!;
    this.asked = {forward: run.column('asked_v_mps'), turning: run.column('asked_omega_radps')};
    this.share = {forward: run.column('granted_v'), turning: run.column('granted_omega')};
    const product = (a: Float64Array, b: Float64Array) => a.map((value, i) => value * b[i]);
    this.granted = {
      forward: product(this.asked.forward, this.share.forward),
      turning: product(this.asked.turning, this.share.turning),
    };
    const left = run.column('v_left_mps');
    const right = run.column('v_right_mps');
    this.driven = {
      forward: left.map((v, i) => (v + right[i]) / 2),
      turning: left.map((v, i) => (right[i] - v) / run.info.robot.track),
    };
  }

  at(of: {forward: Float64Array; turning: Float64Array}, tick: number): Velocity {
    return {forward: of.forward[tick], turning: of.turning[tick]};
  }

  /** The largest value that a scale needs. */
  most(part: 'forward' | 'turning'): number {
    const {max_speed, track} = this.run.info.robot;
    const limit = MOST * (part === 'forward' ? max_speed : (2 * max_speed) / track);
    let most = 0;
    for (const values of [this.asked[part], this.driven[part]]) {
      for (const value of values) most = Math.max(most, Math.abs(value));
    }
    return Math.max(0.05, Math.min(limit, most));
  }

  reason(tick: number): string {
    return this.info.guarded ? this.info.reasons[this.run.column('reason')[tick]] : 'no_guard';
  }
  says(tick: number): string {
    return (REASONS[this.reason(tick)] ?? BARE).says;
  }
  colour(tick: number): Colour {
    return (REASONS[this.reason(tick)] ?? BARE).colour;
  }
}
