// The image drives in a world: chip, body and simulator, a millisecond at a time.
import {readFileSync} from 'node:fs';
import {Body} from './body.mjs';
import {Chip} from './chip.mjs';
import {IMAGE} from './paths.mjs';
import {Rig} from './rig.mjs';

const MS = 1e6;
const STANDS_UM_S = 1000;
const PAINT = 0xc0dec0de;
const RAM_TOP = 256 * 1024;

export class Drive {
  ms = 0;
  /** Takes what the robot sends, instead of the simulator. */
  takesBytes = null;
  /** Of the simulator's last line. */
  now = {ordered: false, outcome: 'none', fault: 'none', base: 'off_bus', speeds: [0, 0], contact: false};
  /** prepare(chip): before the power comes. The sensors are those of the robot's file. */
  constructor(rigArguments, {image = IMAGE, seed = 1, prepare = () => {}} = {}) {
    this.chip = new Chip({seed});
    this.chip.flash.load(readFileSync(image));
    const robot = rigArguments[rigArguments.indexOf('--robot') + 1];
    this.body = new Body(this.chip, /^sonar = true/m.test(readFileSync(robot, 'utf8')));
    this.rig = new Rig(rigArguments);
    prepare(this.chip);
    this.chip.powerOn();
  }
  step() {
    this.chip.run(++this.ms * MS);
    this.takesBytes?.(this.body.sent.splice(0));
    const words = this.rig.ask(this.body.line()).split(' ');
    this.body.feel(words);
    const [left, right, contact, ordered, outcome, fault, base] = words.slice(14, 21);
    this.now = {
      ordered: ordered === 'ordered',
      outcome,
      fault,
      base,
      speeds: [Number(left), Number(right)],
      contact: contact === '1',
    };
    this.firstCommandMs ??= this.body.motors.asleep ? undefined : this.ms;
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
