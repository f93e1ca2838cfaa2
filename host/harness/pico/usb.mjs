// The USB controller of the chip as a device: RP2040 data sheet, 4.1. The package's own takes a packet for sent as soon as
// it is there, answers without a cable, and looks at no PID, no STALL and no clock.

const [EP0_IN_CONTROL, LAST_CONTROL] = [0x80, 0xfc];
const [AVAILABLE, STALL, DATA1, FULL] = [1 << 10, 1 << 11, 1 << 13, 1 << 15];
const LENGTH = 0x3ff;
const [ENABLE, PER_BUFFER, PLACE] = [1 << 31, 1 << 29, 0xffc0];
const TYPES = {bulk: 2, interrupt: 3};
const EP0_PLACE = 0x100;

// Registers.
const [ADDRESS, MAIN, SIE_CTRL, SIE_STATUS, BUFFERS, STALL_ARM, MUXING, POWER, INTR, INTE, INTS] = [
  0x00, 0x40, 0x4c, 0x50, 0x58, 0x68, 0x74, 0x78, 0x8c, 0x90, 0x98,
];
const KEPT = new Set([ADDRESS, MAIN, SIE_CTRL, STALL_ARM, MUXING, POWER, INTE]);
const [EP0_INTERRUPT, PULLUP] = [1 << 29, 1 << 16];
export const EVENTS = {suspended: 1 << 4, resume: 1 << 11, setup: 1 << 17, reset: 1 << 19};
/** Bits of INTR by those of SIE_STATUS. */
const INTERRUPTS = new Map([
  [EVENTS.suspended, 1 << 14],
  [EVENTS.resume, 1 << 15],
  [EVENTS.setup, 1 << 16],
  [EVENTS.reset, 1 << 12],
]);
const ON_BUFFER = 1 << 4;
const ON_PHY = 0x9; // TO_PHY, SOFTCON
const SEES_POWER = 0xc; // VBUS_DETECT, by its override
const CLOCK_HZ = 48e6;

const hex = (number) => `0x${(number >>> 0).toString(16)}`;

export class UsbController {
  name = 'USB';
  /** The other end of the cable: called when the program has changed what it gives or takes, or is there or not. */
  onChange = () => {};
  #registers = new Map();
  #status = 0;
  #buffers = 0;
  #controls = new Uint32Array(32);
  #writtenAt = new Float64Array(32);

  constructor(mcu, irq, chip) {
    this.mcu = mcu;
    this.irq = irq;
    this.chip = chip;
  }
  enterReset() {
    this.#registers.clear();
    this.#controls.fill(0);
    this.#status = this.#buffers = 0;
    this.#update();
    this.onChange();
  }
  #get(offset) {
    return this.#registers.get(offset) ?? 0;
  }
  #update() {
    this.mcu.setInterrupt(this.irq, (this.#pending & this.#get(INTE)) !== 0);
  }
  get #pending() {
    let pending = this.#buffers === 0 ? 0 : ON_BUFFER;
    for (const [event, interrupt] of INTERRUPTS) if (this.#status & event) pending |= interrupt;
    return pending;
  }
  /** CLK_USB runs from a PLL that is locked. */
  get #clocked() {
    const {clocks, pllUsb, clock} = this.mcu;
    return (
      (clocks.usbCtrl & 0xee0) === 0x800 && clock.nanos >= pllUsb.lockedAt && pllUsb.frequency === CLOCK_HZ
    );
  }
  /** The host sees a device. */
  get attached() {
    const on = this.#get(MAIN) & 1 && this.#get(SIE_CTRL) & PULLUP && (this.#get(MUXING) & ON_PHY) === ON_PHY;
    return Boolean(on) && (this.#get(POWER) & SEES_POWER) === SEES_POWER && this.#clocked;
  }
  readUint32(offset) {
    switch (offset) {
      case SIE_STATUS:
        return this.#status >>> 0;
      case BUFFERS:
        return this.#buffers >>> 0;
      case INTR:
        return this.#pending;
      case INTS:
        return this.#pending & this.#get(INTE);
      default:
        if (!KEPT.has(offset))
          this.chip.sin(`a register of the USB that this model does not have: ${hex(offset)}`);
        return this.#get(offset);
    }
  }
  writeUint32Atomic(offset, value, kind) {
    if (offset === SIE_STATUS || offset === BUFFERS) {
      if (kind === 1 || kind === 2) return this.chip.sin('a bit of the USB that is cleared by a one is set');
      if (offset === SIE_STATUS) this.#status &= ~value;
      else this.#buffers &= ~value;
    } else {
      const before = kind === 0 ? 0 : this.readUint32(offset);
      if (!KEPT.has(offset)) return this.chip.sin(`a store to a register of the USB: ${hex(offset)}`);
      const word = [value, before ^ value, before | value, before & ~value][kind] >>> 0;
      if (offset === MAIN && word & 1 && !this.#clocked) this.chip.sin('the USB is on without its 48 MHz');
      this.#registers.set(offset, word);
      if (offset !== INTE) this.onChange();
    }
    this.#update();
  }
  /** The program has stored a word in the memory that it shares with the controller. */
  DPRAMUpdated(offset, value) {
    const resets = this.mcu.peripherals[0x4000c];
    if ((resets.reset >> 24) & 1) this.chip.sin(`the memory of the USB is in reset: +${hex(offset)}`);
    if (offset < EP0_IN_CONTROL || offset > LAST_CONTROL) return;
    const i = (offset - EP0_IN_CONTROL) >> 2;
    const [before, now] = [this.#controls[i], this.mcu.core.cycles];
    const since = (now - this.#writtenAt[i]) / this.mcu.clkSys;
    this.#controls[i] = value >>> 0;
    this.#writtenAt[i] = now;
    if (!(value & AVAILABLE)) return;
    if (before & AVAILABLE) this.chip.sin('a buffer is given to the USB twice');
    else if ((before | AVAILABLE) >>> 0 !== value >>> 0)
      this.chip.sin('AVAILABLE comes with the rest of a buffer control');
    else if (since < 1 / CLOCK_HZ) this.chip.sin('AVAILABLE comes before the USB has seen the rest');
    const control = i < 2 ? 0 : this.#word(8 + 4 * (i - 2));
    if (i >= 2 && !(control & ENABLE)) this.chip.sin('a buffer of an endpoint that is not enabled');
    if (!(value & FULL) !== Boolean(i & 1)) this.chip.sin('FULL is wrong for the direction');
    this.onChange();
  }
  #word(offset) {
    return this.mcu.usbDPRAMView.getUint32(offset, true);
  }
  /** The controller changes a buffer control. */
  #change(i, value) {
    this.#controls[i] = value >>> 0;
    this.mcu.usbDPRAMView.setUint32(EP0_IN_CONTROL + 4 * i, value >>> 0, true);
  }
  #answers(address) {
    return this.attached && (this.#get(ADDRESS) & 0x7f) === address;
  }
  #raise(event) {
    if (!this.attached) return;
    this.#status |= event;
    this.#update();
  }
  // What the host does.

  busReset() {
    this.#raise(EVENTS.reset);
  }
  suspend() {
    this.#raise(EVENTS.suspended);
  }
  resume() {
    this.#raise(EVENTS.resume);
  }
  /** A SETUP, which a device never refuses; it takes no buffer of endpoint 0 back. False: nobody answers. */
  setup(address, bytes) {
    if (!this.#answers(address)) return false;
    this.mcu.usbDPRAM.set(bytes, 0);
    this.#registers.set(STALL_ARM, 0);
    this.#raise(EVENTS.setup);
    return true;
  }
  /** The place of an endpoint's buffer; null: nobody answers. */
  #place(i, kind) {
    if (i < 2) return EP0_PLACE;
    const control = this.#word(8 + 4 * (i - 2));
    if (!(control & ENABLE) || ((control >> 26) & 3) !== TYPES[kind]) return null;
    return control & PLACE;
  }
  #begin(address, i, kind) {
    const place = this.#answers(address) ? this.#place(i, kind) : null;
    if (place === null) return {silent: true};
    const control = this.#controls[i];
    if (control & STALL && (i >= 2 || (this.#get(STALL_ARM) >> i) & 1)) return {stall: true};
    if (!(control & AVAILABLE)) return {nak: true};
    return {place, control, data1: (control & DATA1) !== 0};
  }
  #end(i) {
    const tells = i < 2 ? this.#get(SIE_CTRL) & EP0_INTERRUPT : this.#word(8 + 4 * (i - 2)) & PER_BUFFER;
    if (tells) this.#buffers = (this.#buffers | (1 << i)) >>> 0;
    this.#update();
  }
  /** {silent}, {stall}, {nak}, or {data1, bytes}, which the host acknowledges. */
  in(address, endpoint, kind) {
    const i = 2 * endpoint;
    const answer = this.#begin(address, i, kind);
    if (answer.place === undefined) return answer;
    const bytes = this.mcu.usbDPRAM.slice(answer.place, answer.place + (answer.control & LENGTH));
    this.#change(i, answer.control & ~(AVAILABLE | FULL));
    this.#end(i);
    return {data1: answer.data1, bytes};
  }
  /** {silent}, {stall}, {nak}, or {ack}. */
  out(address, endpoint, kind, data1, bytes) {
    const i = 2 * endpoint + 1;
    const answer = this.#begin(address, i, kind);
    if (answer.place === undefined) return answer;
    // It takes the packet for one that it has had.
    if (answer.data1 !== data1) this.chip.sin(`endpoint ${endpoint} waits for DATA${answer.data1 ? 1 : 0}`);
    if (bytes.length > (answer.control & LENGTH))
      this.chip.sin(`${bytes.length} bytes for endpoint ${endpoint}`);
    this.mcu.usbDPRAM.set(bytes, answer.place);
    this.#change(i, (answer.control & ~(AVAILABLE | LENGTH)) | FULL | bytes.length);
    this.#end(i);
    return {ack: true};
  }
}
