// A computer with a USB cable: it enumerates the device as a strict host, and a program on it opens the serial port.
// USB 2.0, chapters 5, 8 and 9; Communications Device Class 1.2, PSTN.

const MS = 1e6;
const DEBOUNCE_NS = 100 * MS; // USB 2.0, 7.1.7.3
const RESET_NS = 10 * MS;
const RECOVERY_NS = 10 * MS;
const AFTER_ADDRESS_NS = 2 * MS;
const SUSPENDED_AFTER_NS = 3 * MS;
const AGAIN_NS = 20000; // after a NAK of a control transfer
const REQUEST_NS = 500 * MS; // 9.2.6.4; of a request without data, 50
const TURN_NS = 4000;
const IDLE = Infinity; // until something changes
const NAK_NS = 4500;
const READ_BYTES = 512; // of a program's read: it ends with these, or with a short packet

/** Of a transaction at full speed: 5.11.3. */
const timeOf = (bytes) => 9107 + 83.54 * Math.floor(3.167 + (7 * 8 * bytes) / 6);

const [DEVICE, CONFIGURATION, STRING, INTERFACE, ENDPOINT, QUALIFIER, ASSOCIATION, CLASS] = [
  1, 2, 3, 4, 5, 6, 11, 0x24,
];
const word = (bytes, at) => bytes[at] | (bytes[at + 1] << 8);

/** bmRequestType, bRequest, wValue, wIndex, wLength. */
export const setupOf = (type, request, value = 0, index = 0, length = 0) =>
  Uint8Array.of(type, request, value, value >> 8, index, index >> 8, length, length >> 8);

export class UsbHost {
  /** What a device must not do. */
  complaints = [];
  /** The device as its descriptors tell it; null: it is not configured. */
  device = null;
  /** A program has the port open. */
  open = true;
  onByte = () => {};
  enumerations = 0;
  #reads = true;
  #plugged = false;
  #awake = true;
  #jobs = [];
  #out = [];
  #read = [];
  #way = null;
  #sleeps = false;
  #alarm = null;

  constructor({plugged = false} = {}) {
    this.#plugged = plugged;
  }
  /** Of Chip: after each of its resets. */
  plug(mcu) {
    this.controller = mcu.usbCtrl;
    this.clock = mcu.clock;
    this.#alarm = mcu.clock.createAlarm(() => this.#go());
    this.controller.onChange = () => this.#wake();
    this.#begin();
  }
  get plugged() {
    return this.#plugged;
  }
  connect(on) {
    if (on === this.#plugged) return;
    this.#plugged = on;
    if (this.#alarm) this.#begin();
  }
  /** From a program to the device, or nothing while it is not there. */
  feed(bytes) {
    if (this.device === null || !this.open) return;
    for (let at = 0; at < bytes.length; at += 64) this.#out.push(Uint8Array.from(bytes.slice(at, at + 64)));
    this.#wake();
  }
  /** A bus reset, after which it enumerates anew. */
  reset() {
    this.#begin(false);
  }
  /** No frames on the bus; or again. */
  sleep(on) {
    this.#awake = !on;
    this.#jobs.push(this.#sleepJob(on));
    this.#wake();
  }
  setOpen(on) {
    this.open = on;
    if (this.device === null) return;
    if (!on) this.#out = [];
    this.#jobs.push(this.#lineState());
    this.#wake();
  }
  /** A program that has the port open reads it, or does not. */
  setReading(on) {
    this.#reads = on;
    this.#wake();
  }
  /** A request besides; then(answer): its bytes, or null after a STALL. */
  request(setup, then = () => {}, data = []) {
    this.#jobs.push(
      function* () {
        then(yield* this.#control(setup, data));
      }.call(this),
    );
    this.#wake();
  }
  /** A request that is given up after its SETUP. */
  abandon(setup) {
    this.#jobs.push(
      function* () {
        this.controller.setup(this.address, setup);
        yield timeOf(8);
      }.call(this),
    );
    this.#wake();
  }
  complain(what) {
    if (this.complaints.length < 100) this.complaints.push(what);
  }

  #begin(appears = true) {
    this.device = null;
    this.address = 0;
    this.#awake = true;
    this.#jobs = [];
    this.#out = [];
    this.#read = [];
    this.#way = this.#plugged ? this.#run(appears) : this.#leave();
    this.#sleeps = false;
    this.#alarm.cancel();
    this.#alarm.schedule(TURN_NS);
  }
  #go() {
    const {value, done} = this.#way.next();
    this.#sleeps = done || value === IDLE;
    if (!this.#sleeps) this.#alarm.schedule(value);
  }
  #wake() {
    if (!this.#sleeps) return;
    this.#sleeps = false;
    this.#alarm.schedule(TURN_NS);
  }
  *#leave() {
    yield SUSPENDED_AFTER_NS;
    this.controller.suspend();
  }
  *#run(appears) {
    while (!this.controller.attached) yield IDLE;
    if (appears) yield DEBOUNCE_NS;
    yield* this.#busReset();
    const first = yield* this.#describe(DEVICE, 0, 8);
    if (first?.length !== 8 || first[7] !== 64) return this.complain('no first bytes of a device descriptor');
    yield* this.#busReset();
    if ((yield* this.#control(setupOf(0x00, 5, 5))) === null) return this.complain('no address');
    this.address = 5;
    yield AFTER_ADDRESS_NS;
    const device = yield* this.#known();
    if (device === null) return;
    if ((yield* this.#control(setupOf(0x00, 9, device.value))) === null)
      return this.complain('no configuration');
    this.toggles = {in: false, out: false};
    const status = yield* this.#control(setupOf(0x80, 0, 0, 0, 2));
    if (status?.length !== 2) return this.complain('no status');
    const coding = [0x00, 0xc2, 0x01, 0x00, 0, 0, 8];
    yield* this.#control(setupOf(0x21, 0x20, 0, device.control, 7), coding);
    const said = yield* this.#control(setupOf(0xa1, 0x21, 0, device.control, 7));
    if (String(said) !== String(coding)) this.complain(`another line coding: ${said}`);
    this.device = device;
    this.enumerations++;
    if (this.open) yield* this.#lineState();
    for (;;) {
      if (!this.controller.attached) return this.#begin();
      if (this.#jobs.length) yield* this.#jobs.shift();
      else yield* this.#data();
    }
  }
  *#busReset() {
    this.address = 0;
    this.controller.busReset();
    yield RESET_NS + RECOVERY_NS;
  }
  *#sleepJob(on) {
    if (on) yield SUSPENDED_AFTER_NS;
    if (on) this.controller.suspend();
    else this.controller.resume();
    if (!on) yield RECOVERY_NS;
  }
  *#lineState() {
    const setup = setupOf(0x21, 0x22, this.open ? 3 : 0, this.device.control);
    if ((yield* this.#control(setup)) === null) this.complain('no line state');
  }
  *#describe(kind, number, length, language = 0) {
    const bytes = yield* this.#control(setupOf(0x80, 6, (kind << 8) | number, language, length));
    if (bytes !== null && bytes[1] !== kind) this.complain(`descriptor ${kind}: ${bytes}`);
    return bytes;
  }
  *#text(number) {
    const bytes = yield* this.#describe(STRING, number, 255, 0x0409);
    if (bytes?.[0] !== bytes?.length) this.complain(`string ${number}: ${bytes}`);
    return new TextDecoder('utf-16le').decode(bytes?.slice(2) ?? new Uint8Array());
  }
  /** What the descriptors say. */
  *#known() {
    const device = yield* this.#describe(DEVICE, 0, 18);
    if (device?.length !== 18) return this.complain('no device descriptor') ?? null;
    if (word(device, 2) >= 0x0200 && (yield* this.#describe(QUALIFIER, 0, 10)) !== null)
      this.complain('a device of full speed has another speed');
    const head = yield* this.#describe(CONFIGURATION, 0, 9);
    const all = head && (yield* this.#describe(CONFIGURATION, 0, word(head, 2)));
    if (all?.length !== word(head ?? [0, 0, 0, 0], 2))
      return this.complain('no configuration descriptor') ?? null;
    const languages = yield* this.#describe(STRING, 0, 255);
    if (languages === null || word(languages, 2) !== 0x0409) this.complain(`languages: ${languages}`);
    return {
      vendor: word(device, 8),
      product: word(device, 10),
      maker: yield* this.#text(device[14]),
      name: yield* this.#text(device[15]),
      serial: yield* this.#text(device[16]),
      value: all[5],
      milliamperes: 2 * all[8],
      ...this.#interfaces(device, all),
    };
  }
  #interfaces(device, all) {
    const found = {control: null, in: null, out: null};
    let current = null;
    let count = 0;
    for (let at = 9; at < all.length; at += all[at]) {
      if (all[at] < 2 || at + all[at] > all.length)
        return this.complain(`a descriptor of ${all[at]} bytes`) ?? found;
      const [, kind, a, b] = all.slice(at);
      if (kind === ASSOCIATION && (b !== 2 || String(device.slice(4, 7)) !== '239,2,1'))
        this.complain('an association of interfaces that the device does not announce');
      if (kind === INTERFACE) {
        count++;
        current = all[at + 5];
        if (current === 2) found.control = a;
      }
      if (kind === CLASS && current !== 2) this.complain('a class descriptor in another interface');
      if (kind === ENDPOINT && current === 10) {
        if (b !== 2 || word(all, at + 4) !== 64) this.complain('another endpoint than bulk of 64 bytes');
        found[a & 0x80 ? 'in' : 'out'] = a & 0x0f;
      }
    }
    if (count !== all[4]) this.complain(`${count} interfaces instead of ${all[4]}`);
    if (Object.values(found).includes(null)) this.complain('not a serial port');
    return found;
  }
  /** A control transfer: its bytes, or null after a STALL. */
  *#control(setup, data = []) {
    const [toHost, length] = [setup[0] & 0x80, word(setup, 6)];
    const until = this.clock.nanos + REQUEST_NS;
    const name = [...setup].map((byte) => byte.toString(16).padStart(2, '0')).join(' ');
    /** Until it is no NAK; null: a STALL. */
    const soon = function* (transaction, bytes) {
      for (;;) {
        yield timeOf(bytes);
        const answer = transaction();
        if (answer.stall) return null;
        if (!answer.nak && !answer.silent) return answer;
        if (this.clock.nanos > until) {
          this.complain(`${name}: no answer`);
          return null;
        }
        yield AGAIN_NS;
      }
    }.bind(this);
    const into = (data1, size, what) => (answer) => {
      if (answer && answer.data1 !== data1)
        this.complain(`${name}: DATA${answer.data1 ? 1 : 0} in its ${what}`);
      if (answer && answer.bytes.length > size)
        this.complain(`${name}: ${answer.bytes.length} bytes in its ${what}`);
      return answer;
    };
    const {controller, address} = this;
    if (!controller.setup(address, setup)) return this.complain(`${name}: nobody is there`) ?? null;
    const bytes = [];
    if (toHost && length > 0) {
      for (let data1 = true; ; data1 = !data1) {
        const left = length - bytes.length;
        const answer = into(
          data1,
          Math.min(64, left),
          'data',
        )(yield* soon(() => controller.in(address, 0), 64));
        if (answer === null) return null;
        bytes.push(...answer.bytes);
        if (answer.bytes.length < 64 || bytes.length >= length) break;
      }
      return (yield* soon(() => controller.out(address, 0, '', true, []), 0)) && Uint8Array.from(bytes);
    }
    if (length > 0 && (yield* soon(() => controller.out(address, 0, '', true, data), data.length)) === null)
      return null;
    return into(true, 0, 'status')(yield* soon(() => controller.in(address, 0), 0)) && new Uint8Array();
  }
  /** What the program reads and writes: one packet each way, or a rest. */
  *#data() {
    let moved = false;
    if (this.open && this.#reads && this.#awake) {
      const answer = this.controller.in(this.address, this.device.in, 'bulk');
      if (answer.bytes) {
        moved = true;
        if (answer.data1 !== this.toggles.in) this.complain(`bulk: DATA${answer.data1 ? 1 : 0} again`);
        this.toggles.in = !answer.data1;
        yield timeOf(answer.bytes.length);
        this.#read.push(...answer.bytes);
        if (answer.bytes.length < 64 || this.#read.length >= READ_BYTES)
          this.#read.splice(0).forEach((byte) => this.onByte(byte));
      }
    }
    if (this.#out.length && this.#awake) {
      const [packet] = this.#out;
      const answer = this.controller.out(this.address, this.device.out, 'bulk', this.toggles.out, packet);
      if (answer.ack) {
        moved = true;
        this.#out.shift();
        this.toggles.out = !this.toggles.out;
      }
      yield answer.ack ? timeOf(packet.length) : NAK_NS;
    }
    // A bus reset or a job may have come meanwhile.
    if (!moved && !this.#jobs.length) yield this.#out.length ? AGAIN_NS : IDLE;
  }
}
