// A VL53L0X at its registers, as Linux's driver uses them (drivers/iio/proximity/vl53l0x-i2c.c): SYSRANGE_START 0x00
// with the mode back to back 0x02, SYSTEM_INTERRUPT_CLEAR 0x0B, RESULT_INTERRUPT_STATUS 0x13 with the mask 0x07,
// RESULT_RANGE_STATUS 0x14 with the distance in bytes 10 and 11 of twelve, model number 0xEE at 0xC0.

const DEFAULT_ADDRESS = 0x29;
const WAKE_NS = 1.2e6; // data sheet DocID029104, tBOOT
const OK = 0;
const CLEAR = 1;
const TOO_NEAR = 2;

export class Vl53l0x {
  /** 'unplugged', 'dead' (keeps its address, measures no more), 'stuck' (the last distance), 'laser', 'mute' (answers no address). */
  fault = null;
  awake = false;
  address = DEFAULT_ADDRESS;
  measurements = 0;
  #registers = new Uint8Array(256);
  #pointer = 0;
  #first = false;
  #since = 0;

  constructor(chip, xshut) {
    this.chip = chip;
    this.xshut = xshut;
    this.#boot();
  }
  plug(mcu) {
    this.mcu = mcu;
    const pin = mcu.gpio[this.xshut];
    const follow = () => {
      // The module's own resistor pulls XSHUT up, so a pin that is not driven wakes it.
      const high = !pin.outputEnable || pin.outputValue;
      if (high && !this.awake) this.#since = mcu.clock.nanos;
      if (!high) this.#boot();
      this.awake = high;
    };
    pin.addListener(follow);
    this.awake = false;
    follow();
  }
  #boot() {
    this.address = DEFAULT_ADDRESS;
    this.#registers.fill(0);
    this.#registers[0xc0] = 0xee;
    this.measures = false;
  }
  /** Its supply fails for a moment. */
  glitch() {
    this.#boot();
  }
  answers(address) {
    const ready = this.awake && this.mcu.clock.nanos - this.#since >= WAKE_NS;
    return ready && this.fault !== 'unplugged' && this.fault !== 'mute' && address === this.address;
  }
  begin() {
    this.#first = true;
  }
  write(byte) {
    if (this.#first) {
      this.#first = false;
      this.#pointer = byte;
      return true;
    }
    const register = this.#pointer++ & 0xff;
    if (register === 0x8a) this.address = byte & 0x7f;
    else if (register === 0x0b) this.#registers[0x13] &= ~7;
    else if (register === 0x00) this.measures = byte === 0x02;
    else this.chip.sin(`a store to register 0x${register.toString(16)} of a VL53L0X`);
    return true;
  }
  read() {
    return this.#registers[this.#pointer++ & 0xff];
  }
  /** A measurement has ended: status and distance of the simulator. */
  measured(mm, status) {
    if (!this.awake || !this.measures || this.fault === 'dead' || this.fault === 'unplugged') return;
    this.measurements++;
    if (this.fault !== 'stuck') {
      const code =
        this.fault === 'laser' ? 3 : status === OK || status === TOO_NEAR ? 11 : status === CLEAR ? 4 : 15;
      const distance = status === TOO_NEAR ? 0 : status === OK ? mm : 8190;
      this.#registers[0x14] = code << 3;
      this.#registers[0x14 + 10] = distance >> 8;
      this.#registers[0x14 + 11] = distance & 0xff;
    }
    this.#registers[0x13] |= 4;
  }
}
