// What is soldered to the pins of a robot: sensors, motors, encoders, button. The simulator says what they see.
import {HcSr04} from './hcsr04.mjs';
import {I2cBus} from './i2c.mjs';
import {Mpu6050} from './mpu6050.mjs';
import {UsbHost} from './usb_host.mjs';
import {Vl53l0x} from './vl53l0x.mjs';

export const PINS = {
  data: 4,
  clock: 5,
  awake: [6, 7, 8], // of an HC-SR04: TRIG
  echoes: [2, 3, 9],
  encoders: [10, 12],
  bumpers: [14, 15],
  motors: [16, 18],
  motorsAwake: 20,
  tick: 21,
  button: 22,
  led: 25,
};
const FUNCTION_PWM = 4;
const FULL = 32767;
const QUARTERS = [0, 1, 3, 2]; // levels of B and A
const MODULUS = 1 << 24;
const MS = 1e6;
const HAND_MM = 100;
const BY_HAND = 2; // counts in a millisecond

/** Levels of two inputs as a share of the time with a voltage across the motor, signed: DRV8833 data sheet, table 1. */
export class MotorDriver {
  /** By wheel: a motor that does not turn, or whose wires are broken. */
  stalled = [false, false];
  /** By wheel: its two wires are swapped. */
  swapped = [false, false];
  plug(mcu) {
    this.mcu = mcu;
  }
  #high(pin) {
    const gpio = this.mcu.gpio[pin];
    if (gpio.functionSelect === FUNCTION_PWM) {
      const slice = this.mcu.pwm.channels[(pin >> 1) & 7];
      if (!(slice.csr & 1)) return 0;
      const level = pin & 1 ? slice.cc >>> 16 : slice.cc & 0xffff;
      return Math.min(1, level / (slice.top + 1));
    }
    return gpio.outputEnable && gpio.outputValue ? 1 : 0;
  }
  /** Between -32767 and 32767. Both pulses begin together, so the share of one high input is the difference. */
  duty(wheel) {
    const awake = this.mcu.gpio[PINS.motorsAwake];
    if (!(awake.outputEnable && awake.outputValue) || this.stalled[wheel]) return 0;
    const first = PINS.motors[wheel];
    const share = this.#high(first) - this.#high(first + 1);
    return Math.round((this.swapped[wheel] ? -share : share) * FULL);
  }
  get asleep() {
    const awake = this.mcu.gpio[PINS.motorsAwake];
    return !(awake.outputEnable && awake.outputValue);
  }
}

/** The edges of an encoder, at even distances within a millisecond. */
export class Quadrature {
  /** 'unplugged' (both pulled up), 'dead' (no edge any more), 'a' (one channel broken), 'swapped' (A and B). */
  fault = null;
  count = 0;
  constructor(pin) {
    this.pin = pin;
  }
  plug(mcu) {
    this.mcu = mcu;
    this.due = [];
    this.alarm = mcu.clock.createAlarm(() => this.#edge());
    this.#levels();
  }
  #levels() {
    const levels = QUARTERS[this.count & 3];
    const pins = [this.mcu.gpio[this.pin], this.mcu.gpio[this.pin + 1]];
    const [a, b] = this.fault === 'swapped' ? pins.reverse() : pins;
    if (this.fault === 'dead') return;
    const open = this.fault === 'unplugged';
    a.setInputValue(open || this.fault === 'a' || (levels & 1) !== 0);
    b.setInputValue(open || (levels & 2) !== 0);
  }
  #edge() {
    this.count += this.step;
    this.#levels();
    if (--this.left > 0) this.alarm.schedule(this.between);
  }
  /** From now on for a millisecond. */
  turn(counts) {
    // The last edges of the millisecond before may still be due by a rounding.
    while (this.left > 0) this.#edge();
    this.alarm.cancel();
    let change = (counts - (this.count & (MODULUS - 1)) + MODULUS) % MODULUS;
    if (change >= MODULUS / 2) change -= MODULUS;
    if (change === 0) return this.#levels();
    this.step = Math.sign(change);
    this.left = Math.abs(change);
    this.between = MS / (this.left + 1);
    this.alarm.schedule(this.between);
  }
}

export class Body {
  /** sonar: three HC-SR04 instead of three VL53L0X. usb: its cable is that of the USB socket. */
  constructor(chip, {sonar = false, usb = false} = {}) {
    this.chip = chip;
    this.cable = !usb;
    this.usb = chip.attach(new UsbHost({plugged: usb}));
    this.usb.onByte = (byte) => this.sent.push(byte);
    this.byUsb = usb;
    this.bus = chip.attach(new I2cBus(chip, 0, {data: PINS.data, clock: PINS.clock}));
    this.rangers = PINS.awake.map((pin, beam) =>
      chip.attach(sonar ? new HcSr04(chip, pin, PINS.echoes[beam]) : new Vl53l0x(chip, pin)),
    );
    this.gyro = chip.attach(new Mpu6050());
    this.bus.devices.push(...(sonar ? [] : this.rangers), this.gyro);
    this.motors = chip.attach(new MotorDriver());
    this.encoders = PINS.encoders.map((pin) => chip.attach(new Quadrature(pin)));
    this.sequences = [-1, -1, -1];
    this.pressed = false;
    this.hand = null; // the beam before which a hand is held
    this.turned = [0, 0]; // counts of each wheel by hand
    this.turns = [0, 0]; // and still to turn
    this.sent = [];
    this.misses = []; // of the flash's cache in each tick
    this.atRest = new Set(); // the numbers of the ticks before which the motors had no duty
    this.ticks = []; // cycles of the core, with those of the handlers within
    chip.attach(this);
  }
  plug(mcu) {
    this.mcu = mcu;
    for (const pin of [PINS.button, ...PINS.bumpers]) mcu.gpio[pin].setInputValue(true);
    mcu.uart[0].onByte = (byte) => this.sent.push(byte);
    mcu.uart[0].connected = this.cable;
    mcu.gpio[1].setInputValue(true);
    this.led = false;
    mcu.gpio[PINS.led].addListener((value) => (this.led = value === 1));
    let [began, missed, rests] = [0, 0, true];
    mcu.gpio[PINS.tick].addListener((value) => {
      if (value === 1) {
        [began, missed] = [mcu.core.cycles, this.chip.misses];
        rests = this.motors.duty(0) === 0 && this.motors.duty(1) === 0;
      } else if (began !== 0) {
        if (rests) this.atRest.add(this.ticks.length);
        this.ticks.push(mcu.core.cycles - began);
        this.misses.push(this.chip.misses - missed);
      }
    });
  }
  press(down) {
    this.mcu.gpio[PINS.button].setInputValue(!down);
  }
  bump(side, closed) {
    this.mcu.gpio[PINS.bumpers[side]].setInputValue(!closed);
  }
  connect(on) {
    if (this.byUsb) return this.usb.connect(on);
    this.cable = on;
    this.mcu.uart[0].connected = on;
  }
  /** Over its cable. */
  tell(bytes) {
    (this.byUsb ? this.usb : this.mcu.uart[0]).feed(bytes);
  }
  /** Of the last millisecond: what the simulator needs. */
  line() {
    const bytes = this.sent
      .splice(0)
      .map((byte) => byte.toString(16).padStart(2, '0'))
      .join('');
    return `${this.motors.duty(0)} ${this.motors.duty(1)} ${bytes || '-'}`;
  }
  /** For the next millisecond: what the simulator says. */
  feel(words) {
    this.encoders.forEach((encoder, wheel) => {
      const step = Math.min(this.turns[wheel], BY_HAND);
      this.turns[wheel] -= step;
      this.turned[wheel] += step;
      encoder.turn((Number(words[wheel]) + this.turned[wheel]) % MODULUS);
    });
    this.rangers.forEach((ranger, beam) => {
      const [mm, status, sequence] = words.slice(2 + 3 * beam, 5 + 3 * beam).map(Number);
      if (sequence === this.sequences[beam]) return;
      this.sequences[beam] = sequence;
      if (beam === this.hand) ranger.measured(HAND_MM, 0);
      else ranger.measured(mm, status);
    });
    this.gyro.pass(Number(words[12]), Number(words[13]));
    const hex = words.at(-1);
    if (hex !== '-') this.tell(hex.match(/../g).map((pair) => parseInt(pair, 16)));
  }
}
