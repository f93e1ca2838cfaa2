// A Raspberry Pi Pico: rp2040js, strict always, with its flash chip, its boot ROM, and its resets.
import {RP2040} from 'rp2040js';
import {Flash, plugFlash} from './flash.mjs';
import * as strict from './strict.mjs';
import {Uart} from './uart.mjs';
import {UsbController} from './usb.mjs';

const UART0_IRQ = 20;
const USB_IRQ = 5;
/** Of PSM.WDSEL, without the oscillators. */
const ALL_STAGES = 0x1fffc;
const SILENT = {debug() {}, info() {}, warn() {}, error() {}};

/** The ring oscillator, whose lowest bit is noise; the noise of a chip begins with its seed. */
class RingOscillator {
  name = 'ROSC';
  constructor(seed) {
    this.state = seed >>> 0;
  }
  readUint32(offset) {
    if (offset !== 0x1c) return 0;
    this.state = (Math.imul(this.state, 1664525) + 1013904223) >>> 0;
    return this.state >>> 31;
  }
  writeUint32Atomic() {}
}

export class Chip {
  /** What the chip would not have forgiven, without a fault: accesses to what is in reset, has no clock, is full. */
  sins = [];
  /** HardFaults: why, and where. */
  faults = [];
  /** 'power', 'watchdog', 'forced' or 'request', in order. */
  resets = [];
  lockup = false;
  crystalDead = false;
  /** The PLL of the USB never locks. */
  usbClockDead = false;
  /** Of the flash's cache, if they are counted. */
  misses = 0;
  countsMisses = false;
  /** Waits for a UF2 file, because its second-stage bootloader is damaged. */
  waitsForUsb = false;
  powered = false;
  #devices = [];
  #reset = null;

  constructor({seed = 1} = {}) {
    this.flash = new Flash(seed);
    this.flash.onPowerLost = () => this.losePower();
    this.seed = seed;
  }
  sin(what) {
    if (this.sins.length < 100) this.sins.push(what);
  }
  /** device.plug(mcu): now if there is power, and after each reset. */
  attach(device) {
    this.#devices.push(device);
    if (this.powered) device.plug(this.mcu);
    return device;
  }
  powerOn() {
    this.#start('power', new RP2040());
  }
  /** The supply fails, and comes back. */
  losePower() {
    this.#reset = {kind: 'power'};
  }
  get nanos() {
    return this.mcu.clock.nanos;
  }
  #start(kind, mcu, nanos = 0) {
    this.mcu = mcu;
    this.powered = true;
    this.lockup = false;
    this.resets.push(kind);
    mcu.clock.nanosCounter = nanos;
    mcu.logger = {...SILENT};
    strict.repairDivider(mcu);
    strict.rememberPins(mcu);
    mcu.uart[0] = mcu.peripherals[0x40034] = new Uart(mcu, UART0_IRQ, this);
    mcu.usbCtrl = mcu.peripherals[0x50110] = new UsbController(mcu, USB_IRQ, this);
    this.seed = (Math.imul(this.seed, 69069) + 1) >>> 0;
    mcu.peripherals[0x40060] = new RingOscillator(this.seed);
    strict.repairSleep(mcu);
    strict.raiseFaults(mcu);
    // Devices change peripherals before the resets and the clocks guard them.
    for (const device of this.#devices) device.plug(mcu);
    strict.holdInReset(mcu, this);
    strict.gateClocks(mcu, this);
    this.pio = new strict.PioClock(mcu);
    const watchdog = mcu.peripherals[0x40058];
    watchdog.onWatchdogTrigger = () => {
      watchdog.timer.enable = watchdog.alarm.enable = false;
      const stages = mcu.peripherals[0x40010].readUint32(8);
      if ((stages & ALL_STAGES) !== ALL_STAGES)
        return this.sin('the watchdog is told to reset only a part of the chip');
      this.#reset = {kind: watchdog.reason === 1 ? 'watchdog' : 'forced', reason: watchdog.reason};
    };
    const store = mcu.ppb.writeUint32.bind(mcu.ppb);
    mcu.ppb.writeUint32 = (offset, value) => {
      if (offset !== 0xd0c) return store(offset, value);
      if (value >>> 16 === 0x05fa && value & 4) this.#reset = {kind: 'request', reason: 0};
    };
    if (this.countsMisses) strict.countMisses(mcu, this);
    this.waitsForUsb = !plugFlash(mcu, this.flash, this)();
    this.pwmOff(mcu);
  }
  /** No edges of the pulses: a motor knows its duty from the registers. They cost more than all the rest. */
  pwmOff(mcu) {
    for (const channel of mcu.pwm.channels)
      channel.alarmA.enable = channel.alarmB.enable = channel.alarmBottom.enable = false;
  }
  #restart() {
    const {kind, reason} = this.#reset;
    this.#reset = null;
    const old = this.mcu;
    const mcu = new RP2040();
    if (kind !== 'power') {
      mcu.sram.set(old.sram);
      mcu.peripherals[0x40058].scratchData.set(old.peripherals[0x40058].scratchData);
      mcu.peripherals[0x40058].reason = reason;
    }
    this.#start(kind, mcu, old.clock.nanos);
  }
  /** Until this time, or until stop() at the end of an instruction. */
  run(until, stop = () => false) {
    while (this.mcu.clock.nanosCounter < until) {
      this.#runCore(until, stop);
      if (this.#reset === null) return;
      this.#restart();
    }
  }
  #runCore(until, stop) {
    const {mcu, pio} = this;
    const {core, clock} = mcu;
    while (clock.nanosCounter < until && this.#reset === null) {
      const cycleNs = 1e9 / mcu.clkSys;
      if (core.waiting || this.waitsForUsb) {
        const alarm = clock.nextAlarm === null ? Infinity : clock.nextAlarm.nanos;
        const time = Math.max(0, Math.min(alarm, until) - clock.nanosCounter);
        pio.advance(time / cycleNs);
        clock.tick(time);
        if (this.lockup || this.waitsForUsb) core.waiting = true;
        continue;
      }
      const cycles = strict.executeInstruction(mcu, this);
      pio.advance(cycles);
      const then = clock.nanosCounter + cycles * cycleNs;
      if (clock.nextAlarm !== null && clock.nextAlarm.nanos <= then) clock.tick(cycles * cycleNs);
      else clock.nanosCounter = then;
      if (stop()) return;
    }
  }
}
