// The emulated Raspberry Pi Pico with its simulator, apart from the page: it drives up to a time, and tells what it sees.
import {Drive} from '../../../../harness/pico/drive.mjs';
import {Core} from './core.ts';
import {PinWatch} from './pico_pins.mjs';

const SLICE_MS = 10; // of the robot, between two looks at what the page wants
const TELLS_EVERY_MS = 40;
const MEASURED_MS = 1000; // over which the speed is measured

/** The simulator of host/lab/play/pico_exports.cpp, asked as the one of host/harness/pico/rig.mjs. */
class Rig {
  #wasm;
  constructor(wasm) {
    this.#wasm = wasm;
  }
  #read(count) {
    return new TextDecoder().decode(new Uint8Array(this.#wasm.memory.buffer, this.#wasm.text(count), count));
  }
  ask(line) {
    const at = this.#wasm.text(line.length);
    new TextEncoder().encodeInto(line, new Uint8Array(this.#wasm.memory.buffer, at, line.length));
    return this.#read(this.#wasm.ask());
  }
  verdict() {
    return JSON.parse(this.#read(this.#wasm.verdict()));
  }
  nameOf(id) {
    return this.#read(this.#wasm.message(id));
  }
}

class PicoDrive {
  #until = 0;
  #runs = false;
  #told = -Infinity;
  #passed = 0;
  #spent = {ms: 0, since: 0, speed: 0};
  static async start({image, module, world}) {
    const {instance} = await WebAssembly.instantiate(module, {});
    const core = new Core(instance.exports);
    core.write(world);
    if (!instance.exports.begin_pico())
      throw new Error('The robot of the Pico would touch an obstacle at its start.');
    return new PicoDrive(core, instance.exports, image);
  }
  constructor(core, wasm, image) {
    this.core = core;
    this.wasm = wasm;
    this.rig = new Rig(wasm);
    this.drive = new Drive(this.rig, image);
    this.watch = new PinWatch(this.drive, (id) => this.rig.nameOf(id));
    this.robot = core.robotOf(0);
    this.tell();
  }
  change(world) {
    this.core.write(world);
    this.wasm.change(0);
  }
  runUntil(seconds) {
    this.#until = Math.round(seconds * 1000);
    if (!this.#runs) this.#slice();
  }
  get #over() {
    return this.core.result(0).outcome !== null;
  }
  #slice() {
    const {drive} = this;
    const began = performance.now();
    const from = drive.ms;
    for (const end = Math.min(this.#until, from + SLICE_MS); drive.ms < end;) drive.step();
    const now = performance.now();
    this.#measure(drive.ms - from, now - began);
    this.#runs = drive.ms < this.#until && !this.#over;
    if (!this.#runs || now - this.#told > TELLS_EVERY_MS) this.tell();
    if (this.#runs) soon(() => this.#slice());
  }
  /** How fast it is while it runs: what it waits for the page does not count. */
  #measure(ms, spent) {
    const all = this.#spent;
    all.ms += ms;
    all.since += spent;
    if (all.since < MEASURED_MS && all.speed > 0) return;
    all.speed = all.ms / all.since;
    if (all.since >= MEASURED_MS) all.ms = all.since = 0;
  }
  tell() {
    this.#told = performance.now();
    const record = new Map();
    this.core.record(0, record);
    const way = this.core.way(0, this.#passed);
    this.#passed += way.length / 3;
    postMessage({
      record,
      result: {...this.core.result(0), hash: this.drive.commands},
      way,
      cells: this.core.clearCells(0),
      map: this.core.map(0),
      robot: this.robot,
      difference: this.rig.verdict().difference,
      pins: {...this.watch.look(), speed: this.#spent.speed},
    });
  }
}

/** What cannot go on is told to the page. */
async function attempt(what) {
  try {
    await what();
  } catch (error) {
    postMessage({fault: error.message});
  }
}

/** After the messages that have come. */
const channel = new MessageChannel();
let next = () => {};
channel.port1.onmessage = () => attempt(next);
function soon(what) {
  next = what;
  channel.port2.postMessage(null);
}

let drive = null;
onmessage = ({data}) =>
  attempt(async () => {
    if (data.image) drive = PicoDrive.start(data);
    const here = await drive;
    if (data.change) here.change(data.change);
    if (data.pull) here.watch.pull(data.pull);
    if (data.until !== undefined) here.runUntil(data.until);
  });
