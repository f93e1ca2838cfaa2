// PL011 UART with its queues, its line's time, and its flags: RP2040 data sheet, 4.2.

const DEPTH = 32;
const [RX, TX, RT, OE] = [1 << 4, 1 << 5, 1 << 6, 1 << 10];
const LEVELS = [4, 8, 16, 24, 28];

export class Uart {
  name = 'UART0';
  #sent = [];
  #received = [];
  #wire = []; // bytes that the other end has still to send
  #registers = new Map();
  #raw = 0;
  /** The other end of the cable: called with each byte at the end of its time. */
  onByte = () => {};
  connected = true;

  constructor(mcu, irq, chip) {
    this.mcu = mcu;
    this.irq = irq;
    this.chip = chip;
    this.transmitting = mcu.clock.createAlarm(() => this.#transmitted());
    this.arriving = mcu.clock.createAlarm(() => this.#arrived());
    this.idle = mcu.clock.createAlarm(() => {
      if (this.#received.length) this.#raise(RT);
    });
    this.busy = false;
    this.coming = false;
  }
  enterReset() {
    this.#registers.clear();
    this.#sent = [];
    this.#received = [];
    this.#raw = 0;
    this.#update();
  }
  #get(offset) {
    return this.#registers.get(offset) ?? 0;
  }
  get #enabled() {
    return (this.#get(0x30) & 0x301) === 0x301 && this.mcu.clocks.periFreq > 0;
  }
  get #depth() {
    return this.#get(0x2c) & 0x10 ? DEPTH : 1;
  }
  get baud() {
    return this.mcu.clocks.periFreq / (16 * (this.#get(0x24) + this.#get(0x28) / 64));
  }
  get #byteNs() {
    return (10 * 1e9) / this.baud;
  }
  get #rxLevel() {
    return this.#get(0x2c) & 0x10 ? LEVELS[(this.#get(0x34) >> 3) & 7] : 1;
  }
  get #txLevel() {
    return this.#get(0x2c) & 0x10 ? LEVELS[this.#get(0x34) & 7] : 0;
  }
  #raise(bit) {
    this.#raw |= bit;
    this.#update();
  }
  #update() {
    this.mcu.setInterrupt(this.irq, (this.#raw & this.#get(0x38)) !== 0);
  }
  /** From the other end, at the speed of the line. */
  feed(bytes) {
    if (!this.connected) return;
    this.#wire.push(...bytes);
    if (!this.coming) this.#nextArrival();
  }
  #nextArrival() {
    this.coming = this.#wire.length > 0;
    if (this.coming) this.arriving.schedule(this.#enabled ? this.#byteNs : 1e5);
  }
  #arrived() {
    const byte = this.#wire.shift();
    if (this.#enabled && this.connected) {
      if (this.#received.length >= this.#depth) this.#raise(OE);
      else this.#received.push(byte);
      if (this.#received.length >= this.#rxLevel) this.#raise(RX);
      this.idle.schedule((32 * 1e9) / this.baud);
    }
    this.#nextArrival();
  }
  #transmit() {
    this.busy = this.#sent.length > 0 && this.#enabled;
    if (this.busy) this.transmitting.schedule(this.#byteNs);
  }
  #transmitted() {
    const byte = this.#sent.shift();
    if (this.#sent.length <= this.#txLevel) this.#raise(TX);
    if (this.connected) this.onByte(byte);
    this.#transmit();
  }
  readUint32(offset) {
    switch (offset) {
      case 0x00: {
        const byte = this.#received.shift() ?? 0;
        if (this.#received.length < this.#rxLevel) this.#raw &= ~RX;
        if (!this.#received.length) this.#raw &= ~RT;
        this.#update();
        return byte;
      }
      case 0x18:
        return (
          (this.busy ? 0x08 : 0) |
          (this.#received.length ? 0 : 0x10) |
          (this.#sent.length >= this.#depth ? 0x20 : 0) |
          (this.#received.length >= this.#depth ? 0x40 : 0) |
          (this.#sent.length ? 0 : 0x80)
        );
      case 0x3c:
        return this.#raw;
      case 0x40:
        return this.#raw & this.#get(0x38);
      default:
        return this.#get(offset);
    }
  }
  writeUint32Atomic(offset, value, kind) {
    const before = kind === 0 ? 0 : this.readUint32(offset);
    const word = [value, before ^ value, before | value, before & ~value][kind] >>> 0;
    switch (offset) {
      case 0x00:
        if (!this.#enabled) return this.chip.sin('the UART sends while it is off or has no clock');
        if (this.#sent.length >= this.#depth) return this.chip.sin('a byte for the UART without room');
        this.#sent.push(word & 0xff);
        if (this.#sent.length > this.#txLevel) this.#raw &= ~TX;
        if (!this.busy) this.#transmit();
        break;
      case 0x44:
        this.#raw &= ~value;
        break;
      default:
        this.#registers.set(offset, word);
    }
    this.#update();
  }
}
