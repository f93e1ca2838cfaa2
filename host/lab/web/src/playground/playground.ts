/** The world, its robots, and the changes of the user. */
import {Camera} from '../camera.ts';
import type {World} from '../data.ts';
import {sceneBoxOf} from '../scene_box.ts';
import type {Core} from './core.ts';
import {YOU, type Driver} from './driver.ts';
import {GuardRun} from './guard_run.ts';
import {LiveRun} from './live.ts';
import type {OpenedTable} from './opened_table.ts';
import {PICO, PicoRun, type Chip} from './pico.ts';
import {teamsOf, type State, type Teams} from './share.ts';
import type {Situation} from './situation.ts';
import {distanceTo, moved, sized, withNew, without, type NewKind, type Thing} from './things.ts';

/** The least distance in metres between a robot and a new object. */
const KEPT_FREE = 0.005;
/** Milliseconds of a frame that the simulation may take. */
const BUDGET = 11;
const HURRIED_BUDGET = 40;
const BATCH = 20;

export class Playground {
  readonly camera = new Camera();
  situation: Situation;
  runs: LiveRun[] = [];
  selected: Thing | null = null;
  playing = false;
  speed = 1;
  /** The user changed the world during the run: no scenario repeats it. */
  touched = false;
  /** The table in the place of that of the rules. It is no part of the state: a link has no room for it. */
  opened: OpenedTable | null = null;
  private owed = 0;
  private hurried = false;
  private readonly listeners: (() => void)[] = [];

  constructor(
    private readonly core: Core,
    public state: State,
    private readonly driver: Driver,
    private readonly chip: Chip,
  ) {
    this.situation = this.given();
    this.begin();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  get teams(): Teams {
    return teamsOf(this.core.words.planners);
  }
  get planners(): readonly string[] {
    return this.teams[this.state.who];
  }
  /** Which parts of the page belong to the run. */
  get kind(): 'mission' | 'guard' | 'pico' {
    return this.drivenByUser ? 'guard' : this.state.who === PICO ? 'pico' : 'mission';
  }
  get drivenByUser(): boolean {
    return this.state.who === YOU;
  }
  get over(): boolean {
    return this.runs.every((run) => run.over);
  }
  get time(): number {
    return Math.max(...this.runs.map((run) => run.result.time));
  }
  /** "u-trap, seed 7" */
  get name(): string {
    const {kind, seed, own} = this.state;
    return `${kind}, seed ${seed}${own ? ', changed' : ''}`;
  }

  /** Restarts the run in the current world. */
  begin(): void {
    this.situation = {...this.situation, noise: this.state.noise};
    this.chip.stop();
    this.runs = this.planners.map((planner, side) => {
      if (planner === YOU) return new GuardRun(this.core, this.situation, this.driver);
      if (planner === PICO) return new PicoRun(this.chip, this.situation);
      return new LiveRun(this.core, side, planner, this.situation);
    });
    this.touched = false;
    this.owed = 0;
    this.hurried = false;
    this.changed();
  }

  /** Sets the state; the generator makes the world unless the state contains one. */
  restore(state: State): boolean {
    const before = this.state;
    this.state = state;
    try {
      this.situation = this.given();
    } catch {
      this.state = before;
      return false;
    }
    this.selected = null;
    this.begin();
    return true;
  }

  setPlaying(on: boolean): void {
    this.playing = on;
    this.hurried = false;
    this.changed();
  }

  setWho(who: State['who']): void {
    this.state = {...this.state, who};
    this.begin();
  }

  /** The switches of the driver have changed: a drive that has begun goes on with a new guard. */
  rewire(): void {
    if (this.time === 0 || this.over) {
      this.begin();
      return;
    }
    this.core.setGuard(this.driver.switches);
    this.touched = true;
    this.changed();
  }

  setNoise(noise: number[]): void {
    this.state = {...this.state, noise};
    this.begin();
  }

  /** The rules are the default ones while a table is opened. */
  setRules(rules: string | null, opened: OpenedTable | null): void {
    this.state = {...this.state, rules};
    this.opened = opened;
    if (this.time > 0) this.touched = true;
    this.changed();
  }

  select(thing: Thing | null): void {
    this.selected = thing;
    this.changed();
  }

  move(dx: number, dy: number): boolean {
    const thing = this.selected;
    if (!thing) return false;
    return this.edit(moved(this.situation.world, thing, dx, dy), thing);
  }

  size(factor: number): boolean {
    const thing = this.selected;
    return thing !== null && this.edit(sized(this.situation.world, thing, factor), thing);
  }

  remove(): boolean {
    const thing = this.selected;
    if (!thing || thing.kind === 'start' || thing.kind === 'goal') return false;
    this.selected = null;
    return this.edit(without(this.situation.world, thing), null);
  }

  /** Adds an object near the middle of the view, where there is room. */
  add(kind: NewKind): boolean {
    for (let i = 0; i < 60; ++i) {
      // On a spiral: evenly spread, from the middle outwards.
      const [angle, radius] = [2.4 * i, 0.35 * Math.sqrt(i)];
      const at: [number, number] = [
        this.camera.x + radius * Math.cos(angle),
        this.camera.y + radius * Math.sin(angle),
      ];
      const [world, thing] = withNew(this.situation.world, kind, at);
      if (!this.edit(world, thing)) continue;
      this.select(thing);
      return true;
    }
    return false;
  }

  fit(width: number, height: number): void {
    this.camera.fit(sceneBoxOf(this.situation.world, []), width, height, 16);
  }

  /** Advances by real time, s. */
  pass(seconds: number): void {
    const {period} = this.core.robot;
    this.owed = this.hurried ? Infinity : this.owed + (seconds * this.speed) / period;
    const until = performance.now() + (this.hurried ? HURRIED_BUDGET : BUDGET);
    const waits = () => this.runs.some((run) => run.waits);
    while (this.owed >= 1 && !this.over && !waits() && performance.now() < until) {
      const ticks = Math.min(BATCH, Math.floor(this.owed));
      for (const run of this.runs) run.advance(ticks);
      this.owed -= ticks;
    }
    // Time that the machine cannot simulate in this frame is dropped.
    if (this.owed >= 1) this.owed = 0;
    for (const run of this.runs) run.refresh();
    if (this.over) this.playing = this.hurried = false;
  }

  /** Runs at full speed until all robots have a verdict. */
  hurry(): void {
    if (this.over) return;
    this.playing = this.hurried = true;
    this.changed();
  }

  private given(): Situation {
    const {own, kind, seed, noise} = this.state;
    const situation = own ?? this.core.generate(kind, seed, false);
    if (!situation || this.core.judge(situation) !== 'good') throw new Error('no such world');
    return {...situation, noise};
  }

  private edit(world: World, thing: Thing | null): boolean {
    const situation = {...this.situation, world};
    if (this.core.judge(situation) !== 'good') return false;
    // A robot takes its goal before it drives.
    const start = thing?.kind === 'start' || (thing?.kind === 'goal' && this.kind === 'pico');
    if (thing && !start && thing.kind !== 'goal' && !this.clearOfRobots(world, thing)) return false;
    this.situation = situation;
    this.state = {...this.state, own: situation};
    if (start) {
      this.begin();
      return true;
    }
    for (const run of this.runs) run.change(situation);
    if (this.time > 0) this.touched = true;
    else this.begin();
    this.changed();
    return true;
  }

  private clearOfRobots(world: World, thing: Thing): boolean {
    return this.runs.every(
      (run) =>
        distanceTo(world, thing, [run.column('x_m')[0], run.column('y_m')[0]]) >
        run.info.robot.radius + KEPT_FREE,
    );
  }

  private changed(): void {
    for (const listener of this.listeners) listener();
  }
}
