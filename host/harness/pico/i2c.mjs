// The two lines of an I2C bus with its devices: bit times, held lines, and what the package's controller forgives.
import {I2CMode} from 'rp2040js';

const FUNCTION_I2C = 3;
const ABORTED = 1 << 6;
const INTERRUPT_MASK = 0x30;
const CLOCKS_OF_A_BYTE = 9;

export class I2cBus {
  devices = [];
  /** A device that stopped in the midst of a byte holds the data line for so many clocks; Infinity: a short circuit. */
  heldFor = 0;
  transfers = 0;
  /** By device: how often it was addressed, and by the first byte that was written, the bytes that were read. */
  traffic = new Map();

  constructor(chip, number, pins) {
    this.chip = chip;
    this.number = number;
    this.pins = pins; // {data, clock}
  }
  plug(mcu) {
    const controller = mcu.i2c[this.number];
    this.controller = controller;
    let device = null;
    let action = null;
    const alarm = mcu.clock.createAlarm(() => {
      const due = action;
      action = null;
      if (this.heldFor > 0) this.waits = due;
      else due();
    });
    const after = (bits, then) => {
      action = then;
      alarm.schedule(bits * this.#bitNs(mcu));
    };
    controller.onStart = () => after(1, () => controller.completeStart());
    controller.onConnect = (address, mode) => {
      this.transfers++;
      device = this.devices.find((d) => d.answers(address)) ?? null;
      if (mode === I2CMode.Write) device?.begin();
      if (device) this.#note(device, mode);
      after(9, () => controller.completeConnect(device !== null));
    };
    controller.onWriteByte = (byte) => {
      this.#spoken.register ??= byte;
      after(9, () => controller.completeWrite(device.write(byte)));
    };
    controller.onReadByte = () =>
      after(9, () => {
        const byte = device.read();
        this.#spoken.bytes.push(byte);
        controller.completeRead(byte);
      });
    controller.onStop = () => after(1, () => controller.completeStop());
    // After an abort, the chip flushes what is written until the program has read IC_CLR_TX_ABRT.
    const write = controller.writeUint32.bind(controller);
    controller.writeUint32 = (offset, value) => {
      if (offset === INTERRUPT_MASK) {
        // The package has no such register to write.
        controller.intEnable = value & 0x1fff;
        controller.checkInterrupts();
        return;
      }
      if (offset === 0x10 && controller.intRaw & ABORTED) return;
      if (offset === 0x04 && controller.enable & 1 && controller.state !== 0)
        this.chip.sin('a new target address during a transfer');
      write(offset, value);
    };
    controller.enterReset = () => {
      alarm.cancel();
      action = this.waits = null;
      controller.state = 0;
      controller.busy = controller.stop = controller.pendingRestart = false;
      controller.rxFIFO.reset();
      controller.txFIFO.reset();
      controller.enable = controller.intRaw = controller.intEnable = controller.abortSource = 0;
      controller.control = 0x65;
      controller.checkInterrupts();
    };
    const [data, clock] = [mcu.gpio[this.pins.data], mcu.gpio[this.pins.clock]];
    this.#level = () => data.setInputValue(this.heldFor === 0 && !(data.outputEnable && !data.outputValue));
    this.#level();
    clock.setInputValue(true);
    let low = false;
    clock.addListener(() => {
      const pulled = clock.functionSelect !== FUNCTION_I2C && clock.outputEnable && !clock.outputValue;
      if (low && !pulled && this.heldFor > 0) this.#clocked();
      low = pulled;
    });
    data.addListener(() => this.#level());
  }
  #spoken = null;
  #note(device, mode) {
    const known = this.traffic.get(device) ?? {transfers: 0, register: null, bytes: [], read: new Map()};
    this.traffic.set(device, known);
    this.#spoken = known;
    known.transfers++;
    known.bytes = [];
    if (mode === I2CMode.Write) known.register = null;
    else known.read.set(known.register, known.bytes);
  }
  #level = () => {};
  #bitNs(mcu) {
    const {sclHighPeriod, sclLowPeriod} = this.controller;
    return ((sclHighPeriod + sclLowPeriod) * 1e9) / mcu.clkSys;
  }
  #clocked() {
    if (--this.heldFor === 0) this.release();
    this.#level();
  }
  hold(clocks = CLOCKS_OF_A_BYTE) {
    this.heldFor = clocks;
    this.#level();
  }
  release() {
    this.heldFor = 0;
    this.#level();
    const due = this.waits;
    this.waits = null;
    due?.();
  }
}
