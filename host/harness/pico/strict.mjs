// rp2040js forgives what the chip does not. Each function takes one of these liberties away from a chip:
// tests/pico/strict.test.mjs shows for each what the bare package does.

export const FLASH = 0x10000000;
const FLASH_END = 0x14000000;
export const RAM = 0x20000000;
const HARD_FAULT = 3;
const SLOWEST = 125; // cycles between two looks at the PIO while none of its machines runs
const ENTRY_CYCLES = 15; // Cortex-M0+ Technical Reference Manual, 3.3: interrupt latency
const RETURN_CYCLES = 13;

/** Bits of RESETS.RESET by the upper address bits of the peripheral: RP2040 data sheet, 2.14.3. */
const RESET_BITS = {
  0x4004c: 0,
  0x50000: 2,
  0x40044: 3,
  0x40048: 4,
  0x40014: 5,
  0x4001c: 8,
  0x50200: 10,
  0x50300: 11,
  0x40028: 12,
  0x4002c: 13,
  0x40050: 14,
  0x4005c: 15,
  0x4003c: 16,
  0x40040: 17,
  0x40054: 21,
  0x40034: 22,
  0x40038: 23,
  0x50110: 24,
};
const ALL_RESETS = 0x1ffffff;

/** A pending interrupt that PRIMASK holds back ends a WFI and runs no handler. */
export function repairSleep(mcu) {
  const {core} = mcu;
  const check = core.checkForInterrupts.bind(core);
  core.checkForInterrupts = () => {
    if (!core.PM) return check();
    if (core.waiting && pending(core)) core.waiting = false;
    return false;
  };
}

function pending(core) {
  return core.pendingInterrupts & core.enabledInterrupts || core.pendingSystick || core.pendingPendSV;
}

/**
 * Executes an instruction and returns its cycles: WFI does not sleep if an interrupt is pending, entry to a handler and
 * return from it take time, and what raiseFaults() has noticed is a HardFault, or within its handler a lockup.
 */
export function executeInstruction(mcu, chip) {
  const {core} = mcu;
  const before = core.IPSR;
  const at = core.PC;
  let cycles = core.executeInstruction();
  if (core.waiting && pending(core)) core.waiting = false;
  if (mcu.faultReason !== null) {
    chip.faults.push(`${mcu.faultReason}, at 0x${at.toString(16)}`);
    mcu.faultReason = null;
    if (core.IPSR === HARD_FAULT) chip.lockup = core.waiting = true;
    else core.exceptionEntry(HARD_FAULT);
  }
  if (core.IPSR !== before) {
    const more = core.IPSR === 0 ? RETURN_CYCLES : ENTRY_CYCLES;
    core.cycles += more;
    cycles += more;
  }
  return cycles;
}

/** Undefined instructions, unaligned, unmapped and forbidden accesses are faults: see executeInstruction(). */
export function raiseFaults(mcu) {
  const {logger} = mcu;
  mcu.faultReason = null;
  mcu.fault = (what) => {
    mcu.faultReason ??= what;
    return 0;
  };
  mcu.onBreak = () => mcu.fault('undefined instruction or breakpoint');
  logger.warn = (_, text) => {
    if (/invalid memory|undefined address|not implemented yet/.test(text)) mcu.fault(text);
  };
  logger.error = (_, text) => mcu.fault(text);
  const hex = (address) => `0x${(address >>> 0).toString(16)}`;
  const {flash16} = mcu;
  const readHalf = mcu.readUint16.bind(mcu);
  // Nearly all of these are instructions in the flash.
  mcu.readUint16 = (address) => {
    if (address & 1) return mcu.fault(`unaligned access to ${hex(address)}`);
    return address >= FLASH && address < FLASH_END ? flash16[(address & 0xffffff) >> 1] : readHalf(address);
  };
  for (const [name, mask] of Object.entries({writeUint8: 0, writeUint16: 1, writeUint32: 3})) {
    const write = mcu[name].bind(mcu);
    mcu[name] = (address, value) => {
      if (address & mask) mcu.fault(`unaligned access to ${hex(address)}`);
      else if (address >>> 0 < 0x18000000) mcu.fault(`store to ${hex(address)}`);
      else write(address, value);
    };
  }
}

/** Peripherals start in reset; there they take nothing and read 0, and the chip counts the attempt as a sin. */
export function holdInReset(mcu, chip) {
  const resets = mcu.peripherals[0x4000c];
  resets.reset = ALL_RESETS;
  const read = resets.readUint32.bind(resets);
  resets.readUint32 = (offset) => (offset === 8 ? ~resets.reset & ALL_RESETS : read(offset));
  const write = resets.writeUint32.bind(resets);
  resets.writeUint32 = (offset, value) => {
    const before = resets.reset;
    write(offset, value);
    const closed = resets.reset & ~before;
    for (const [page, bit] of Object.entries(RESET_BITS))
      if ((closed >> bit) & 1) mcu.peripherals[page].enterReset?.();
  };
  for (const [page, bit] of Object.entries(RESET_BITS)) {
    const peripheral = mcu.peripherals[page];
    const open = (offset) => {
      if (!((resets.reset >> bit) & 1)) return true;
      chip.sin(`${peripheral.name} is in reset: +0x${offset.toString(16)}`);
      return false;
    };
    const load = peripheral.readUint32.bind(peripheral);
    const store = peripheral.writeUint32Atomic.bind(peripheral);
    // Inside of the atomic store, the peripheral reads itself.
    peripheral.readUint32 = (offset) => (open(offset) ? load(offset) : 0);
    peripheral.writeUint32Atomic = (offset, value, kind) => {
      if (open(offset)) store(offset, value, kind);
    };
  }
  mcu.pwm.enterReset = () => mcu.pwm.reset();
  for (const pio of mcu.pio)
    pio.enterReset = () => pio.machines.forEach((machine) => (machine.enabled = false));
  for (const pin of mcu.gpio) {
    pin.padValue = 0x56;
    pin.refreshInput();
  }
}

/** The crystal and a PLL take time; the core starts on the ring oscillator; microseconds need the tick generator. */
export function gateClocks(mcu, chip) {
  const {clock} = mcu;
  mcu.clkSys = mcu.roscFreq;
  mcu.ppb.systickTimer.frequency = mcu.roscFreq;

  const xosc = mcu.peripherals[0x40024];
  let stableAt = Infinity;
  const xoscWrite = xosc.writeUint32.bind(xosc);
  xosc.writeUint32 = (offset, value) => {
    xoscWrite(offset, value);
    if (offset === 0 && xosc.enabled && stableAt === Infinity && !chip.crystalDead)
      stableAt = clock.nanos + ((xosc.startup & 0x3fff) * 256 * 1e9) / mcu.xoscFreq;
  };
  const xoscRead = xosc.readUint32.bind(xosc);
  xosc.readUint32 = (offset) =>
    offset === 4 && clock.nanos < stableAt ? xoscRead(offset) & 0x7fffffff : xoscRead(offset);

  const LOCK_NS = 50000;
  for (const pll of [mcu.pllSys, mcu.pllUsb]) {
    pll.lockedAt = Infinity;
    const write = pll.writeUint32.bind(pll);
    pll.writeUint32 = (offset, value) => {
      write(offset, value);
      const powered = !(pll.pwr & 0x21);
      if (powered && pll.lockedAt === Infinity && !(pll === mcu.pllUsb && chip.usbClockDead))
        pll.lockedAt = clock.nanos + LOCK_NS;
      if (!powered) pll.lockedAt = Infinity;
    };
    const read = pll.readUint32.bind(pll);
    pll.readUint32 = (offset) =>
      offset === 0 && clock.nanos < pll.lockedAt ? read(offset) & 0x7fffffff : read(offset);
  }
  const clocksWrite = mcu.clocks.writeUint32.bind(mcu.clocks);
  mcu.clocks.writeUint32 = (offset, value) => {
    if (offset === 0x30 && (value & 3) === 2 && clock.nanos < stableAt)
      chip.sin('clk_ref runs from a crystal that is not stable');
    if (offset === 0x3c && (value & 0xe1) === 1 && clock.nanos < mcu.pllSys.lockedAt)
      chip.sin('clk_sys runs from a PLL that is not locked');
    clocksWrite(offset, value);
  };

  const watchdog = mcu.peripherals[0x40058];
  const timer = mcu.peripherals[0x40054];
  let since = null; // in ns, when the present run of the tick began
  let counted = 0;
  const ticks = () => watchdog.tickEnable && cycles !== 0 && cycles * 1e6 === mcu.clocks.refFreq;
  let cycles = 0;
  watchdog.tickEnable = false;
  const watchdogWrite = watchdog.writeUint32.bind(watchdog);
  watchdog.writeUint32 = (offset, value) => {
    watchdogWrite(offset, value);
    if (offset !== 0x2c) return;
    cycles = value & 0x1ff;
    if (ticks() && since === null) since = clock.nanos;
    if (!ticks() && since !== null) {
      counted += clock.nanos - since;
      since = null;
    }
  };
  timer.clock = {
    get nanos() {
      return counted + (since === null ? 0 : clock.nanos - since);
    },
  };
  const timerWrite = timer.writeUint32.bind(timer);
  timer.writeUint32 = (offset, value) => {
    const alarm = offset >= 0x10 && offset <= 0x1c;
    if (alarm && since === null) chip.sin('an alarm without the tick generator');
    else timerWrite(offset, value);
  };
}

/** While the flash takes commands, a core that reads it or runs from it gets a fault. Returns the switch. */
export function gateFlash(mcu) {
  const names = ['readUint8', 'readUint16', 'readUint32'];
  const open = names.map((name) => mcu[name]);
  const closed = open.map((read) => (address) => {
    if (address >>> 0 < FLASH || address >>> 0 >= FLASH_END) return read.call(mcu, address);
    mcu.fault(`read of flash at 0x${(address >>> 0).toString(16)} while it takes commands`);
    return 0;
  });
  return (readable) => names.forEach((name, i) => (mcu[name] = readable ? open[i] : closed[i]));
}

/**
 * Counts what the flash's cache does not have: 16 KB in two ways, RP2040 data sheet, 2.6.3; lines of 8 bytes. The cost of a
 * miss is not charged: see XIP_MISS_CYCLES.
 */
export function countMisses(mcu, chip) {
  const LINE = 8;
  const SETS = 16384 / 2 / LINE;
  const lines = new Int32Array(2 * SETS).fill(-1);
  const next = new Uint8Array(SETS);
  const look = (address) => {
    const line = (address & 0xffffff) >> 3;
    const set = 2 * (line % SETS);
    if (lines[set] === line) next[set >> 1] = 1;
    else if (lines[set + 1] === line) next[set >> 1] = 0;
    else {
      chip.misses++;
      lines[set + next[set >> 1]] = line;
      next[set >> 1] ^= 1;
    }
  };
  for (const name of ['readUint16', 'readUint32']) {
    const read = mcu[name].bind(mcu);
    mcu[name] = (address) => {
      if (address >>> 0 >= FLASH && address >>> 0 < FLASH_END) look(address);
      return read(address);
    };
  }
}
/** Address, mode, pause and 8 bytes over four lines are 28 clocks, each two of the core: boot2.cpp. */
export const XIP_MISS_CYCLES = 56;

/** The divider's answers to a division by zero: measured on a chip, vak.dreamwidth.org/1097369. */
export function repairDivider(mcu) {
  const {sio} = mcu;
  const update = sio.updateHardwareDivider.bind(sio);
  sio.updateHardwareDivider = (signed) => {
    const cycles = mcu.core.cycles;
    update(signed);
    mcu.core.cycles = cycles; // the core does not wait: its program does
    if (sio.divDivisor !== 0) return;
    sio.divQuotient = signed && (sio.divDividend | 0) < 0 ? 1 : -1;
    sio.divRemainder = sio.divDividend;
  };
}

/** PIO state machines run with the time of the chip: divider, delays and enable bits. */
export class PioClock {
  constructor(mcu) {
    this.pios = mcu.pio;
    this.owed = 0;
    this.quantum = SLOWEST;
    for (const pio of this.pios) {
      pio.run = () => {};
      for (const machine of pio.machines) {
        machine.debt = 0;
        machine.clkDivRestart = () => (machine.debt = 0);
      }
    }
  }
  /** Core cycles. Machines move on when the fastest of them is due. */
  advance(cycles) {
    this.owed += cycles;
    if (this.owed < this.quantum) return;
    const due = this.owed;
    this.owed = 0;
    this.quantum = SLOWEST;
    for (const pio of this.pios) {
      if (pio.stopped) continue;
      for (const machine of pio.machines) {
        if (!machine.enabled) continue;
        const divider = ((machine.clockDivInt || 0x10000) << 8) | machine.clockDivFrac;
        this.quantum = Math.min(this.quantum, divider / 256);
        machine.debt += due * 256;
        while (machine.debt >= divider) {
          const before = machine.cycles;
          machine.step();
          const took = machine.cycles - before;
          machine.debt -= divider * (took > 1 ? took : 1);
        }
      }
      pio.checkChangedPins();
    }
  }
}

/** Reading all pins is a register of the chip, not a loop over them. */
export function rememberPins(mcu) {
  let values = 0;
  Object.defineProperty(mcu, 'gpioValues', {get: () => values});
  for (const pin of mcu.gpio) {
    const set = pin.setInputValue.bind(pin);
    let known = null;
    const note = () => {
      const bit = 1 << pin.index;
      values = pin.inputValue ? values | bit : values & ~bit;
    };
    pin.setInputValue = (value) => {
      // The package latches an edge again if the level does not change.
      const level = !!value;
      if (level === known) return note();
      known = level;
      set(level);
      note();
    };
    const refresh = pin.refreshInput.bind(pin);
    pin.refreshInput = () => {
      refresh();
      note();
    };
  }
}
