/** The robot that an emulated Raspberry Pi Pico drives: in a worker, out of the file beside the page. */
import type {RobotInfo} from '../data.ts';
import type {Core, Result} from './core.ts';
import {LiveRun, type Driven} from './live.ts';
import {flat, type Situation} from './situation.ts';
import {unpacked} from './packed.ts';

/** Its name in the place of a planner. */
export const PICO = 'pico';

const FILE = 'pico.js';
/** The worker may be this far behind, s. */
const AHEAD = 0.1;

export interface PinsView {
  /** pins: what pico_worker.mjs tells. */
  show(pins: unknown): void;
}

/** What pico.js gives to the page. */
interface Parts {
  worker: string;
  /** As packed.ts reads them. */
  image: string;
  module: string;
  Pins: new (tell: (order: object) => void) => PinsView;
}

/** What the worker tells. */
interface Told {
  record: Map<string, Float64Array>;
  result: Result;
  /** Since it told last. */
  way: Float64Array;
  cells: Float64Array;
  map: Float64Array;
  robot: RobotInfo;
  pins: unknown;
  /** The first answer of the chip that a core on this computer would not have given; "": none. */
  difference: string;
}

function loaded(): Promise<Parts> {
  return new Promise((done, failed) => {
    const script = document.createElement('script');
    script.src = FILE;
    script.onload = () => done((window as unknown as {whiskerPico: Parts}).whiskerPico);
    script.onerror = () =>
      failed(new Error(`${FILE} is not beside this page: scripts/playground makes both.`));
    document.head.append(script);
  });
}

export class Chip implements Driven {
  told: Told | null = null;
  /** Why it does not drive; "": it does, or it is being loaded. */
  fault = '';
  /** Called when the worker has told something. */
  onTold = (): void => {};
  private parts: Promise<Parts> | null = null;
  private worker: Worker | null = null;
  private until = 0;
  private begun = 0;
  private path: number[] = [];
  private pins: PinsView | null = null;

  constructor(private readonly core: Core) {}

  get words(): Core['words'] {
    return this.core.words;
  }
  get robot(): RobotInfo {
    return this.told?.robot ?? this.core.robot;
  }

  /** Each drive has a worker of its own: a used one is slower. */
  stop(): void {
    ++this.begun;
    this.worker?.terminate();
    this.worker = null;
    this.told = null;
    this.until = 0;
    this.path = [];
  }

  /** The first picture, until the worker tells another one, is that of the reference robot. */
  begin(side: number, _: string, situation: Situation): void {
    this.core.begin(side, 'map', situation);
    const {begun} = this;
    this.fault = '';
    this.start(situation, () => begun !== this.begun).catch((error: Error) => {
      this.fault = error.message;
      this.onTold();
    });
  }

  private async start(situation: Situation, late: () => boolean): Promise<void> {
    this.parts ??= loaded();
    const {worker: text, image, module, Pins} = await this.parts;
    const bytes = await Promise.all([image, module].map(unpacked));
    if (late()) return;
    this.pins ??= new Pins((order) => this.worker?.postMessage(order));
    const address = URL.createObjectURL(new Blob([text], {type: 'text/javascript'}));
    const worker = new Worker(address);
    this.worker = worker;
    worker.onmessage = ({data}: MessageEvent<Told & {fault?: string}>) => {
      if (worker !== this.worker) return;
      if (data.fault) this.fault = data.fault;
      else this.hear(data);
      this.onTold();
    };
    worker.postMessage({image: bytes[0], module: bytes[1], world: flat(situation)});
    worker.postMessage({until: this.until});
  }

  private hear(told: Told): void {
    this.told = told;
    this.path.push(...told.way);
    this.pins?.show(told.pins);
  }

  get waits(): boolean {
    return this.until > (this.told?.result.time ?? 0) + AHEAD;
  }
  advance(_: number, ticks: number): void {
    this.until += ticks * this.core.robot.period;
    this.worker?.postMessage({until: this.until});
  }
  change(_: number, situation: Situation): void {
    this.worker?.postMessage({change: flat(situation)});
  }
  record(side: number, into: Map<string, Float64Array>): void {
    if (this.told) for (const [name, column] of this.told.record) into.set(name, column);
    else this.core.record(side, into);
  }
  result(side: number): Result {
    return this.told?.result ?? this.core.result(side);
  }
  way(_: number, from: number): Float64Array {
    return Float64Array.from(this.path.slice(3 * from));
  }
  clearCells(): Float64Array {
    return this.told?.cells ?? new Float64Array();
  }
  mapBytes(side: number): number {
    return this.core.mapBytes(side);
  }
  map(side: number): Float64Array {
    return this.told?.map ?? this.core.map(side);
  }
}

export class PicoRun extends LiveRun<Chip> {
  private seen: Told | null = null;

  constructor(chip: Chip, situation: Situation) {
    super(chip, 0, PICO, situation);
  }

  override get waits(): boolean {
    return this.core.waits;
  }
  override get about(): string {
    return `${this.core.words.abouts[this.core.words.planners.indexOf('map')]} The Pico's image has this planner.`;
  }
  /** Instead of what it does. */
  get sentence(): string {
    if (this.core.fault) return this.core.fault;
    if (!this.seen) return 'The emulator is being loaded.';
    return this.mode() === 'idle'
      ? 'The image starts, and takes its parameters and its goal over its cable.'
      : '';
  }
  get compared(): string {
    const difference = this.seen?.difference;
    return difference
      ? `another answer than the core's: ${difference}`
      : "each answer is the core's on this page";
  }

  override refresh(): void {
    const {told} = this.core;
    if (told && told === this.seen) return;
    super.refresh();
    if (told && !this.seen) this.info = {...this.info, robot: told.robot};
    this.seen = told;
  }
}
