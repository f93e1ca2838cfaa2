/** What the user who drives asks for, which parts are on, and how often the robot touched something. */
import type {Velocity} from '../guard_words.ts';

/** The name of the user in the place of a planner. */
export const YOU = 'you';

export const SWITCHES = ['guarded', 'nods', 'assist'] as const;
export type Switches = Record<(typeof SWITCHES)[number], boolean>;

/** rad/s, of the keys and of the joystick at its edge. */
export const MOST_TURNING = 1.5;
/** Seconds after which an unchanged command is noted again: a command holds for 0.25 s. */
const AGAIN = 0.1;
/** Seconds by which a row is earlier than the tick that it is for, so that rounding cannot delay it. */
const EARLY = 0.004;

interface Row extends Velocity {
  time: number;
}

export class Driver {
  switches: Switches = {guarded: true, nods: true, assist: true};
  contacts = {guarded: 0, bare: 0};
  /** Ahead and to the left, -1 to 1. */
  stick: [ahead: number, left: number] = [0, 0];
  private log: Row[] = [];

  constructor(private readonly robot: {readonly max_speed: number; readonly track: number}) {}

  /** No more than the wheels can do. */
  get asked(): Velocity {
    const [ahead, left] = this.stick;
    const turning = left * MOST_TURNING;
    const most = this.robot.max_speed - (Math.abs(turning) * this.robot.track) / 2;
    return {forward: Math.max(-most, Math.min(most, ahead * this.robot.max_speed)), turning};
  }

  ask(ahead: number, left: number): void {
    this.stick = [ahead, left];
  }

  /** A drive begins. */
  begin(): void {
    this.log = [];
  }

  /** The next ticks, from this time on, get the present command. */
  note(time: number): void {
    const {forward, turning} = this.asked;
    const last = this.log.at(-1);
    const same = last && last.forward === forward && last.turning === turning;
    if (!same || time - last.time >= AGAIN - 1e-9) this.log.push({time, forward, turning});
  }

  /** Its commands as `whisker guard --commands` reads them. */
  csv(): string {
    const rows = this.log.map(
      ({time, forward, turning}) => `${Math.max(0, time - EARLY).toFixed(3)},${forward},${turning}`,
    );
    return `t_s,v_mps,omega_radps\n${rows.join('\n')}\n`;
  }

  /** The lines of a scenario for what is switched off. */
  parameters(): string[] {
    const {nods, assist} = this.switches;
    return [...(nods ? [] : ['guard_nods = false']), ...(assist ? [] : ['guard_assist = false'])];
  }

  touched(): void {
    ++this.contacts[this.switches.guarded ? 'guarded' : 'bare'];
  }
}
