// What the pins of the emulated Pico do, as plain values for the page.
import {PINS} from '../../../../harness/pico/body.mjs';

const RETURN = 13;
const FULL = 32767;
const CYCLES_PER_MS = 125000;
const SENSORS = ['left', 'front', 'right'];

/** What of the robot can be unplugged, and how. */
const PLUGS = {
  ...Object.fromEntries(
    SENSORS.map((name, beam) => [
      `${name} sensor`,
      ({rangers}, out) => (rangers[beam].fault = out ? 'unplugged' : null),
    ]),
  ),
  'left encoder': ({encoders}, out) => (encoders[0].fault = out ? 'unplugged' : null),
  'right encoder': ({encoders}, out) => (encoders[1].fault = out ? 'unplugged' : null),
  'left motor': ({motors}, out) => (motors.stalled[0] = out),
  'right motor': ({motors}, out) => (motors.stalled[1] = out),
  'I2C shorted': ({bus}, out) => (out ? bus.hold(Infinity) : bus.release()),
};

const hex = (bytes) => bytes.map((byte) => byte.toString(16).padStart(2, '0')).join(' ');

/** Notes what the robot says over its cable. nameOf(id): of a frame. */
export class PinWatch {
  bytes = 0;
  /** By identifier. */
  messages = new Map();
  /** Names of PLUGS. */
  out = new Set();
  worst = 0;
  #line = '';
  #ticks = 0;
  constructor(drive, nameOf) {
    this.drive = drive;
    this.nameOf = nameOf;
    drive.chip.attach(this);
  }
  plug(mcu) {
    const uart = mcu.uart[0];
    const pass = uart.onByte;
    uart.onByte = (byte) => {
      pass(byte);
      this.#hear(byte);
    };
  }
  #hear(byte) {
    ++this.bytes;
    if (byte !== RETURN) this.#line += String.fromCharCode(byte);
    else {
      if (this.#line[0] === 't') this.#frame(parseInt(this.#line.slice(1, 4), 16), this.#line.slice(5));
      this.#line = '';
    }
  }
  #frame(id, data) {
    const known = this.messages.get(id) ?? {id, name: this.nameOf(id), count: 0};
    ++known.count;
    known.data = data;
    this.messages.set(id, known);
  }
  /** name: of PLUGS; or in again. */
  pull(name) {
    const out = !this.out.delete(name);
    if (out) this.out.add(name);
    PLUGS[name](this.drive.body, out);
  }
  /** The state now. */
  look() {
    const {chip, body} = this.drive;
    const {gpio} = chip.mcu;
    for (; this.#ticks < body.ticks.length; ++this.#ticks)
      this.worst = Math.max(this.worst, body.ticks[this.#ticks]);
    return {
      ms: this.drive.ms,
      led: body.led,
      awake: !body.motors.asleep,
      duties: [0, 1].map((wheel) => body.motors.duty(wheel) / FULL),
      encoders: body.encoders.map(({count}, i) => ({
        count,
        levels: [0, 1].map((pin) => gpio[PINS.encoders[i] + pin].inputValue),
      })),
      sensors: [...body.rangers, body.gyro].map((device, i) => {
        const {transfers = 0, read = new Map()} = body.bus.traffic.get(device) ?? {};
        const [register = 0, bytes = []] = [...read].sort((a, b) => b[1].length - a[1].length)[0] ?? [];
        return {
          name: SENSORS[i] ?? 'gyro',
          address: device.address ?? 0,
          measurements: device.measurements ?? 0,
          transfers,
          said: `${hex([register])} > ${hex(bytes)}`,
        };
      }),
      tick: {last: (body.ticks.at(-1) ?? 0) / CYCLES_PER_MS, worst: this.worst / CYCLES_PER_MS},
      bytes: this.bytes,
      messages: [...this.messages.values()].sort((a, b) => a.id - b.id),
      plugs: Object.keys(PLUGS).map((name) => ({name, out: this.out.has(name)})),
      sins: [...chip.sins, ...chip.faults],
    };
  }
}
