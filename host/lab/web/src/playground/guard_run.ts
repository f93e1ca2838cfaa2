/** The robot that the user drives. */
import {CommandArcs} from '../command_arcs.ts';
import {BARE, REASONS, shareWords, velocityWords, type Velocity} from '../guard_words.ts';
import type {Colour} from '../theme.ts';
import type {Core} from './core.ts';
import {YOU, type Driver} from './driver.ts';
import {LiveRun, type Looks} from './live.ts';
import type {Situation} from './situation.ts';

export interface Grant {
  guarded: boolean;
  /** A name of GuardReason. */
  reason: string;
  asked: Velocity;
  /** Granted shares of it. */
  share: Velocity;
}

export class GuardRun extends LiveRun<Core> {
  declare grant: Grant;
  private readonly ways = new CommandArcs(this, {
    asked: () => this.grant.asked,
    granted: () => (this.grant.guarded ? this.granted : null),
    colour: () => this.colour,
  });

  constructor(
    core: Core,
    situation: Situation,
    private readonly driver: Driver,
  ) {
    super(core, 0, YOU, situation, () => core.beginGuard(driver.switches, situation));
    driver.begin();
  }

  override get arcs(): CommandArcs {
    return this.ways;
  }

  override get looks(): Looks {
    const colours = [...this.core.words.reasons.map((reason) => REASONS[reason].colour), BARE.colour];
    return {colours, widths: colours.map(() => 3)};
  }

  get granted(): Velocity {
    const {asked, share} = this.grant;
    return {forward: asked.forward * share.forward, turning: asked.turning * share.turning};
  }

  get reason(): string {
    return this.grant.guarded ? this.grant.reason : 'no_guard';
  }
  get colour(): Colour {
    return (REASONS[this.reason] ?? BARE).colour;
  }
  get sentence(): string {
    const {asked, share, guarded} = this.grant;
    const granted = guarded && shareWords(asked, share);
    const why = (REASONS[this.reason] ?? BARE).says;
    return `Asked: ${velocityWords(asked)}.${granted ? ` Granted: ${granted}.` : ''} ${why}`;
  }

  override advance(ticks: number): void {
    if (this.over) return;
    const {forward, turning} = this.driver.asked;
    this.driver.note(this.result.time);
    this.core.command(forward, turning);
    super.advance(ticks);
    if (this.result.outcome === 'contact') this.driver.touched();
  }

  override refresh(): void {
    super.refresh();
    this.grant = this.core.grant();
  }
}
