// An MPU-6050 at its registers: "MPU-6000/MPU-6050 Register Map and Descriptions", RM-MPU-6000A-00, revision 4.2. Asleep
// after its start; a sample of the rate about z goes to the FIFO each 1 + divider milliseconds.

const ADDRESS = 0x68;
const FIFO_BYTES = 1024;
const RESET_NS = 50e6;
const REG = {
  divider: 0x19,
  config: 0x1a,
  fifoEnable: 0x23,
  user: 0x6a,
  power: 0x6b,
  count: 0x72,
  fifo: 0x74,
  who: 0x75,
};

export class Mpu6050 {
  fitted = true;
  /** 'unplugged', or 'dead': it answers, and takes no samples. */
  fault = null;
  resets = 0;
  fifo = [];
  #registers = new Uint8Array(256);
  #pointer = 0;
  #first = false;
  #readyAt = 0;
  #ms = 0;
  #samples = null;
  #sum = 0;
  #rate = 0;

  constructor() {
    this.#boot();
  }
  plug(mcu) {
    this.mcu = mcu;
  }
  #boot() {
    this.#registers.fill(0);
    this.#registers[REG.power] = 0x40;
    this.#registers[REG.who] = 0x68;
    this.fifo = [];
  }
  answers(address) {
    return this.fitted && this.fault !== 'unplugged' && address === ADDRESS;
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
    if (register === REG.power && byte & 0x80) {
      this.#boot();
      this.#readyAt = this.mcu.clock.nanos + RESET_NS;
      this.resets++;
    } else if (this.mcu.clock.nanos >= this.#readyAt) {
      this.#registers[register] = byte;
      if (register === REG.user && byte & 4 && !(byte & 0x40)) this.fifo = [];
    }
    return true;
  }
  read() {
    if (this.#pointer === REG.fifo) return this.fifo.shift() ?? 0;
    const register = this.#pointer++ & 0xff;
    if (register === REG.count) this.#registers[REG.count + 1] = this.fifo.length & 0xff;
    return register === REG.count ? this.fifo.length >> 8 : this.#registers[register];
  }
  /** A millisecond: the simulator's sum of all samples, and their number, modulo 2^32 and 2^16. */
  pass(sum, samples) {
    if (samples !== this.#samples) {
      if (this.#samples !== null) this.#rate = ((sum - this.#sum) | 0) / ((samples - this.#samples) & 0xffff);
      this.#samples = samples;
      this.#sum = sum;
    }
    const filter = this.#registers[REG.config] & 7;
    const awake = !(this.#registers[REG.power] & 0x40);
    if (this.fault === 'dead' || !awake || filter < 1 || filter > 6) return;
    if (++this.#ms <= this.#registers[REG.divider]) return;
    this.#ms = 0;
    if (!(this.#registers[REG.fifoEnable] & 0x10) || !(this.#registers[REG.user] & 0x40)) return;
    const rate = Math.round(this.#rate);
    this.fifo.push((rate >> 8) & 0xff, rate & 0xff);
    while (this.fifo.length > FIFO_BYTES) this.fifo.shift();
  }
}
