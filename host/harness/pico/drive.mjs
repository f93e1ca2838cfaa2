// The image drives in a world: chip, body and simulator, a millisecond at a time.
import {Body} from './body.mjs';
import {Chip} from './chip.mjs';

const MS = 1e6;
const STANDS_UM_S = 1000;
const PAINT = 0xc0dec0de;
const RAM_TOP = 256 * 1024;

export class Drive {
  ms = 0;
  /** FNV-1a over all that the board does to its motors and its cable. */
  hash = 0x811c9dc5;
  /** Takes what the robot sends, instead of the simulator. */
  takesBytes = null;
  /** Of the simulator's last line. */
  now = {
    ordered: false,
    refused: false,
    outcome: 'none',
    fault: 'none',
    base: 'off_bus',
    speeds: [0, 0],
    contact: false,
  };
  /**
   * rig: asked once a millisecond, as host/harness/pico/rig.hpp says. uf2: what is flashed. sonar: HC-SR04 instead of
   * VL53L0X. usb: the simulator talks to the USB socket instead of the UART. prepare(chip): before the power comes.
   */
  constructor(rig, uf2, {sonar = false, usb = false, seed = 1, prepare = () => {}} = {}) {
    this.rig = rig;
    this.chip = new Chip({seed});
    this.chip.flash.load(uf2);
    this.body = new Body(this.chip, {sonar, usb});
    prepare(this.chip);
    this.chip.powerOn();
  }
  step() {
    this.chip.run(++this.ms * MS);
    this.takesBytes?.(this.body.sent.splice(0));
    const line = this.body.line();
    for (let i = 0; i < line.length; i++) this.hash = Math.imul(this.hash ^ line.charCodeAt(i), 0x01000193);
    const words = this.rig.ask(line).split(' ');
    this.body.feel(words);
    const [left, right, contact, ordered, outcome, fault, base] = words.slice(14, 21);
    this.now = {
      ordered: ordered === 'ordered',
      refused: ordered === 'refused',
      outcome,
      fault,
      base,
      speeds: [Number(left), Number(right)],
      contact: contact === '1',
    };
    this.firstCommandMs ??= this.body.motors.asleep ? undefined : this.ms;
  }
  get commands() {
    return (this.hash >>> 0).toString(16).padStart(8, '0');
  }
  /** Until done(), or for so many milliseconds. True: it was done. */
  until(ms, done) {
    for (const end = this.ms + ms; this.ms < end;) {
      this.step();
      if (done(this.now)) return true;
    }
    return false;
  }
  get stands() {
    return this.now.speeds.every((speed) => Math.abs(speed) < STANDS_UM_S);
  }
  /** The deepest stack since the start, bytes: what has overwritten the paint. */
  get stack() {
    const words = new DataView(this.chip.mcu.sram.buffer);
    let at = RAM_TOP - 8192;
    while (at < RAM_TOP && words.getUint32(at, true) === PAINT) at += 4;
    return RAM_TOP - at;
  }
  close() {
    this.rig.close();
  }
}
