// What rp2040js forgives and the chip does not. Each program runs twice: on the bare package, where it gets away with
// it, and on this project's chip.
import assert from 'node:assert/strict';
import {createRequire} from 'node:module';
import {describe, test} from 'node:test';
import {Chip} from '../../host/harness/pico/chip.mjs';
import {crcOfBoot2, blocksOf} from '../../host/harness/pico/flash.mjs';
import {UsbHost} from '../../host/harness/pico/usb_host.mjs';

const require = createRequire(new URL('../../host/harness/pico/package.json', import.meta.url));
const {RP2040} = await import(require.resolve('rp2040js').replace('/cjs/', '/esm/'));

const PROGRAM = 0x20001000;
const VECTORS = 0x20000100;
const MAIL = 0x20000000;
const HANDLER = 0x20002000;

/** Halfwords of Thumb code at PROGRAM; every exception ends in a loop at HANDLER that has left its number in the mail. */
function put(mcu, halfwords) {
  const words = mcu.sramView;
  const half = (at, value) => words.setUint16(at - 0x20000000, value, true);
  const word = (at, value) => words.setUint32(at - 0x20000000, value, true);
  word(VECTORS, 0x20010000);
  for (let i = 1; i < 48; i++) word(VECTORS + 4 * i, HANDLER | 1);
  // mrs r0, ipsr; ldr r1, [pc, #4]; str r0, [r1]; b .
  [0xf3ef, 0x8005, 0x4901, 0x6008, 0xe7fe, 0x46c0].forEach((code, i) => half(HANDLER + 2 * i, code));
  word(HANDLER + 12, MAIL);
  [...halfwords, 0xe7fe].forEach((code, i) => half(PROGRAM + 2 * i, code));
  mcu.core.VTOR = VECTORS;
  mcu.core.SP = 0x20010000;
  mcu.core.PC = PROGRAM;
}
const mail = (mcu, i = 0) => mcu.sramView.getUint32(4 * i, true);

function bare(halfwords, registers = {}, set = () => {}) {
  const mcu = new RP2040();
  mcu.logger = {debug() {}, info() {}, warn() {}, error() {}};
  put(mcu, halfwords);
  for (const [i, value] of Object.entries(registers)) mcu.core.registers[i] = value;
  set(mcu);
  return {
    mcu,
    run(cycles) {
      for (let n = 0; n < cycles;) {
        if (mcu.core.waiting) {
          mcu.clock.tick(8);
          n++;
        } else {
          const took = mcu.core.executeInstruction();
          mcu.clock.tick(8 * took);
          n += took;
        }
      }
      return mcu;
    },
  };
}

/** A chip that runs from its RAM, at 125 MHz. */
function strict(halfwords, registers = {}, set = () => {}) {
  const chip = new Chip();
  chip.powerOn();
  chip.waitsForUsb = false;
  chip.mcu.clkSys = 125e6;
  put(chip.mcu, halfwords);
  for (const [i, value] of Object.entries(registers)) chip.mcu.core.registers[i] = value;
  set(chip.mcu);
  return {
    chip,
    mcu: chip.mcu,
    run(cycles) {
      chip.run(chip.nanos + cycles * 8);
      return chip.mcu;
    },
  };
}

const faults = [
  ['an undefined instruction', [0xde01], {}],
  ['an unaligned load', [0x6801], {0: 0x20003001}],
  ['an unaligned halfword', [0x8801], {0: 0x20003001}],
  ['a load from where nothing is', [0x6801], {0: 0x60000000}],
  ['a store to where nothing is', [0x6001], {0: 0x60000000}],
  ['a store to the null pointer', [0x6001], {0: 0}],
  ['a store into the flash', [0x6001], {0: 0x10001000}],
  ['a byte into the flash', [0x7001], {0: 0x10001000}],
];

describe('faults of the processor', () => {
  for (const [name, program, registers] of faults) {
    test(name, () => {
      assert.notEqual(mail(bare(program, registers).run(40)), 3, 'the bare package goes on');
      const there = strict(program, registers);
      assert.equal(mail(there.run(60)), 3, 'HardFault');
      assert.equal(there.chip.faults.length, 1);
    });
  }
  test('a fault in the handler of a fault is a lockup, which only a reset ends', () => {
    const there = strict([0xde01]);
    there.mcu.sramView.setUint16(HANDLER - 0x20000000, 0xde02, true);
    there.run(100);
    assert.ok(there.chip.lockup);
  });
});

describe('sleep', () => {
  // cpsid i; str r1,[r0] (pends an interrupt); wfi; str r2,[r3] (awake); nop; cpsie i; nop
  const program = [0xb672, 0x6001, 0xbf30, 0x601a, 0x46c0, 0xb662, 0x46c0];
  const registers = {0: 0xe000e200, 1: 1 << 26, 2: 77, 3: MAIL + 4};
  const set = (mcu) => (mcu.core.enabledInterrupts = 1 << 26);
  test('a pending interrupt that is held back ends it', () => {
    assert.equal(mail(bare(program, registers, set).run(50), 1), 0, 'the bare package sleeps for ever');
    const there = strict(program, registers, set);
    there.run(5);
    assert.equal(mail(there.run(60), 1), 77);
    assert.equal(mail(there.mcu), 42, 'its handler runs after cpsie');
  });
  test('its handler waits for cpsie', () => {
    // The interrupt comes while the core sleeps.
    const late = [0xb672, 0xbf30, 0x601a, ...Array(40).fill(0x46c0), 0xb662, 0x46c0];
    const wake = (there) => {
      there.run(20);
      there.mcu.core.setInterrupt(26, true);
      return there.run(15);
    };
    assert.equal(mail(wake(bare(late, registers, set))), 42, 'the bare package runs it at once');
    const there = strict(late, registers, set);
    assert.equal(mail(wake(there)), 0);
    assert.equal(mail(there.mcu, 1), 77);
    assert.equal(mail(there.run(100)), 42);
  });
  test('entry and return of a handler take time', () => {
    const cycles = (there) => {
      const before = there.mcu.core.cycles;
      there.mcu.core.enabledInterrupts = 1 << 26;
      there.mcu.core.setInterrupt(26, true);
      there.run(2);
      return there.mcu.core.cycles - before;
    };
    assert.ok(cycles(bare([0x46c0])) < 5);
    assert.ok(cycles(strict([0x46c0])) >= 15);
  });
});

describe('resets and clocks', () => {
  const load = [0x6801, 0x6019]; // ldr r1,[r0]; str r1,[r3]
  test('a peripheral in reset takes nothing', () => {
    const registers = {0: 0x40044000, 3: MAIL + 4}; // IC_CON
    assert.equal(mail(bare(load, registers).run(20), 1), 0x65);
    const there = strict(load, registers);
    assert.equal(mail(there.run(20), 1), 0);
    assert.equal(there.chip.sins.length, 1);
  });
  test('RESET_DONE says what is out of reset', () => {
    const registers = {0: 0x4000c008, 3: MAIL + 4};
    assert.equal(mail(bare(load, registers).run(20), 1), 0x1ffffff);
    assert.equal(mail(strict(load, registers).run(20), 1), 0);
  });
  test('the timer needs the tick generator', () => {
    const registers = {0: 0x40054028, 3: MAIL + 4}; // TIMERAWL
    const wait = Array(600).fill(0x46c0);
    assert.notEqual(mail(bare([...wait, ...load], registers).run(700), 1), 0);
    const open = (mcu) => mcu.writeUint32(0x4000f000, 1 << 21);
    assert.equal(mail(strict([...wait, ...load], registers, open).run(700), 1), 0);
  });
  test('a PLL locks only with power, and takes time', () => {
    const registers = {0: 0x40028000, 3: MAIL + 4};
    const locked = (mcu) => mail(mcu, 1) >>> 31;
    assert.equal(locked(bare(load, registers).run(20)), 1);
    const open = (mcu) => mcu.writeUint32(0x4000f000, 1 << 12);
    assert.equal(locked(strict(load, registers, open).run(20)), 0);
    const powered = (mcu) => {
      open(mcu);
      mcu.writeUint32(0x4002b004, 0x21);
    };
    const there = strict([...load, 0xe7fc], registers, powered);
    assert.equal(locked(there.run(100)), 0);
    assert.equal(locked(there.run(10000)), 1);
  });
  test('the core starts on the ring oscillator', () => {
    const chip = new Chip();
    chip.powerOn();
    assert.equal(new RP2040().clkSys, 125e6);
    assert.equal(chip.mcu.clkSys, 6.5e6);
  });
  test('a watchdog that is told to reset nothing is a sin, and resets nothing', () => {
    const program = [0xe7fe];
    const arm = (stages) => (mcu) => {
      mcu.writeUint32(0x40024000 + 0xc, 1);
      mcu.writeUint32(0x40024000, 0xfabaa0);
      mcu.writeUint32(0x40008030, 2);
      mcu.writeUint32(0x4005802c, 0x20c);
      mcu.writeUint32(0x40010008, stages);
      mcu.writeUint32(0x40058004, 2000);
      mcu.writeUint32(0x40058000, 1 << 30);
    };
    const wrong = strict(program, {}, arm(0));
    wrong.run(500000);
    assert.deepEqual(wrong.chip.resets, ['power']);
    assert.match(wrong.chip.sins.join(), /watchdog/);
    const right = strict(program, {}, arm(0x1fffc));
    right.run(500000);
    assert.deepEqual(right.chip.resets, ['power', 'watchdog']);
    assert.equal(right.chip.mcu.peripherals[0x40058].reason, 1, 'REASON is kept');
  });
});

const USB = 0x50110000;
const SHARED = 0x50100000; // memory of the controller and the program
const IN_CONTROL = SHARED + 0x90; // of endpoint 2
const [GIVEN, DATA1, STALL] = [0x400, 0x2000, 0x800];

/** Stores of a program that has a bulk endpoint of the USB, with or without its clock. */
function withUsb(mcu, {clock = true, pullup = true} = {}) {
  mcu.writeUint32(0x4000f000, (1 << 24) | (1 << 13));
  if (clock) {
    mcu.writeUint32(0x4002c008, 100); // PLL_USB
    mcu.writeUint32(0x4002f004, 0x21);
    mcu.writeUint32(0x4002c00c, 0x55000);
    mcu.clock.tick?.(1e5);
    mcu.writeUint32(0x40008054, 0x800);
  }
  mcu.writeUint32(SHARED + 0x10, 0xa80001c0);
  mcu.writeUint32(USB + 0x74, 9);
  mcu.writeUint32(USB + 0x78, 0xc);
  mcu.writeUint32(USB + 0x90, 0x1f010);
  mcu.writeUint32(USB + 0x40, 1);
  mcu.writeUint32(USB + 0x4c, 0x20000000 + (pullup ? 0x10000 : 0));
}
/** As a driver must: AVAILABLE after the rest. */
function give(there, word) {
  there.mcu.writeUint32(IN_CONTROL, word);
  there.run(20);
  there.mcu.writeUint32(IN_CONTROL, word | GIVEN);
}
const FULL_PACKET = 0x8000 + 5; // of 5 bytes
const sent = ({mcu}) => (mcu.readUint32(USB + 0x58) & 0x10) !== 0;

describe('USB', () => {
  const wait = Array(100).fill(0x46c0);
  const bareUsb = (options) => bare(wait, {}, (mcu) => withUsb(mcu, options));
  const strictUsb = (options) => strict(wait, {}, (mcu) => withUsb(mcu, options));
  test('a packet is sent when a host takes it', () => {
    const gone = bareUsb({pullup: false});
    give(gone, FULL_PACKET);
    assert.ok(sent(gone), 'the bare package needs no host, and no pull-up');
    const there = strictUsb();
    give(there, FULL_PACKET);
    assert.ok(!sent(there));
    const {data1, bytes} = there.mcu.usbCtrl.in(0, 2, 'bulk');
    assert.deepEqual([data1, bytes.length], [false, 5]);
    assert.ok(sent(there));
    assert.deepEqual(there.mcu.usbCtrl.in(0, 2, 'bulk'), {nak: true});
    assert.deepEqual(there.chip.sins, []);
  });
  test('needs its own clock', () => {
    const gone = bareUsb({clock: false});
    give(gone, FULL_PACKET);
    assert.ok(sent(gone));
    const there = strictUsb({clock: false});
    assert.ok(!there.mcu.usbCtrl.attached);
    assert.match(there.chip.sins.join(), /48 MHz/);
    assert.ok(strictUsb().mcu.usbCtrl.attached);
    assert.ok(!strictUsb({pullup: false}).mcu.usbCtrl.attached);
  });
  test('its memory takes nothing in reset', () => {
    const gone = bare([]);
    gone.mcu.writeUint32(SHARED, 1);
    assert.equal(gone.mcu.readUint32(SHARED), 1);
    const there = strict([]);
    there.mcu.writeUint32(SHARED, 1);
    assert.match(there.chip.sins.join(), /memory of the USB is in reset/);
  });
  test('sees AVAILABLE too early, if it comes with the rest', () => {
    const gone = bareUsb();
    gone.mcu.writeUint32(IN_CONTROL, FULL_PACKET | GIVEN);
    assert.ok(sent(gone));
    const there = strictUsb();
    there.mcu.writeUint32(IN_CONTROL, FULL_PACKET | GIVEN);
    there.mcu.usbCtrl.in(0, 2, 'bulk');
    there.mcu.writeUint32(IN_CONTROL, FULL_PACKET | DATA1);
    there.mcu.writeUint32(IN_CONTROL, FULL_PACKET | DATA1 | GIVEN);
    assert.match(there.chip.sins[0], /with the rest/);
    assert.match(there.chip.sins[1], /before the USB has seen/);
  });
  test('answers with STALL, and only to its address', () => {
    const gone = bareUsb();
    give(gone, FULL_PACKET | STALL);
    assert.ok(sent(gone), 'the bare package sends the packet');
    const there = strictUsb();
    give(there, FULL_PACKET | STALL);
    assert.deepEqual(there.mcu.usbCtrl.in(0, 2, 'bulk'), {stall: true});
    assert.deepEqual(there.mcu.usbCtrl.in(7, 2, 'bulk'), {silent: true});
    there.mcu.writeUint32(USB, 7);
    assert.deepEqual(there.mcu.usbCtrl.in(7, 2, 'bulk'), {stall: true});
  });
  test('a reset of the bus, and a sleep, until the program has seen them', () => {
    const there = strictUsb();
    const pending = () => there.mcu.readUint32(USB + 0x98);
    assert.equal(new RP2040().usbCtrl.suspend, undefined, 'the bare package never sleeps');
    there.mcu.usbCtrl.busReset();
    there.mcu.usbCtrl.suspend();
    assert.equal(pending(), (1 << 12) | (1 << 14));
    there.mcu.writeUint32(USB + 0x50, 1 << 19);
    assert.equal(pending(), 1 << 14);
  });
});

/** A device that answers a request for its descriptor: how, but for right. */
function hostOf(answer) {
  const chip = new Chip();
  const host = chip.attach(new UsbHost({plugged: true}));
  chip.powerOn();
  chip.waitsForUsb = false;
  chip.mcu.clkSys = 125e6;
  put(chip.mcu, []);
  withUsb(chip.mcu);
  const {mcu} = chip;
  const control = (offset, word) => {
    mcu.writeUint32(SHARED + offset, word);
    chip.run(chip.nanos + 200);
    mcu.writeUint32(SHARED + offset, word | GIVEN);
  };
  const until = chip.nanos + 200e6;
  while (chip.nanos < until && !host.complaints.length) {
    chip.run(chip.nanos + 10000);
    const pending = mcu.readUint32(USB + 0x98);
    if (pending & (1 << 12)) mcu.writeUint32(USB + 0x50, 1 << 19);
    if (!(pending & (1 << 16))) continue;
    mcu.writeUint32(USB + 0x50, 1 << 17);
    if (mcu.usbDPRAM[1] !== 6) break;
    [18, 1, 0, 2, 0xef, 2, 1, 64].forEach((byte, i) => (mcu.usbDPRAM[0x100 + i] = byte));
    control(0x80, answer);
    control(0x84, DATA1);
  }
  assert.deepEqual(chip.sins, []);
  return host.complaints.join();
}

describe('a strict USB host', () => {
  test('complains of a wrong toggle, of too many bytes, and of too few', () => {
    assert.equal(hostOf(0x8000 | DATA1 | 8), '');
    assert.match(hostOf(0x8000 | 8), /DATA0 in its data/);
    assert.match(hostOf(0x8000 | DATA1 | 18), /18 bytes in its data/);
    assert.match(hostOf(0x8000 | DATA1 | 7), /no first bytes/);
  });
});

describe('PIO', () => {
  // set x, 31; jmp x-- 1: counts down, one step each instruction.
  const set = (delay, enable, divider) => (mcu) => {
    mcu.writeUint32(0x4000f000, 1 << 10);
    mcu.writeUint32(0x50200048, 0xe03f);
    mcu.writeUint32(0x5020004c, 0x0041 | (delay << 8));
    mcu.writeUint32(0x502000c8, divider << 16);
    mcu.writeUint32(0x502000cc, 0x1f000);
    mcu.writeUint32(0x50200000, enable);
  };
  const x = (there) => there.mcu.pio[0].machines[0].x;
  test('runs with the time of the chip, its divider and its delays', () => {
    const never = bare([0xe7fe], {}, set(0, 1, 100));
    const before = never.mcu.pio[0].machines[0].cycles;
    never.run(1000);
    never.mcu.pio[0].stop();
    assert.equal(never.mcu.pio[0].machines[0].cycles, before, 'the bare package waits for its event loop');
    const there = strict([0xe7fe], {}, set(0, 1, 100));
    there.run(1180);
    assert.equal(x(there), 31 - 10);
    const delayed = strict([0xe7fe], {}, set(3, 1, 100));
    delayed.run(1180);
    assert.equal(x(delayed), 31 - 3);
  });
  test('a machine that is not enabled stands still', () => {
    const there = strict([0xe7fe], {}, set(0, 2, 1));
    there.run(100);
    assert.equal(x(there), 0);
  });
});

describe('pins', () => {
  test('a level that does not change is no edge', () => {
    const edges = (mcu) => {
      mcu.writeUint32(0x4000f000, (1 << 5) | (1 << 8));
      mcu.writeUint32(0x4001c004 + 4 * 3, 0x40);
      mcu.gpio[3].setInputValue(true);
      mcu.gpio[3].updateIRQValue(15);
      mcu.gpio[3].setInputValue(true);
      return mcu.gpio[3].irqStatus & 0xc;
    };
    assert.notEqual(edges(bare([]).mcu), 0);
    assert.equal(edges(strict([]).mcu), 0);
  });
});

describe('the divider', () => {
  const divide = (mcu, a, b) => {
    mcu.sio.writeUint32(0x68, a >>> 0);
    mcu.sio.writeUint32(0x6c, b);
    return mcu.sio.readUint32(0x70) | 0;
  };
  test('by zero answers as the chip does', () => {
    assert.deepEqual([divide(bare([]).mcu, -100, 0), divide(bare([]).mcu, 0, 0)], [-1, 1]);
    const {mcu} = strict([]);
    assert.deepEqual([divide(mcu, 100, 0), divide(mcu, -100, 0), divide(mcu, 0, 0)], [-1, 1, -1]);
    assert.equal(divide(mcu, -7, 2), -3);
  });
});

describe('the boot ROM', () => {
  const block = () => {
    const bytes = new Uint8Array(512);
    const words = new DataView(bytes.buffer);
    const put32 = (i, value) => words.setUint32(4 * i, value, true);
    [0x0a324655, 0x9e5d5157, 0x2000, 0x10000000, 256, 0, 1, 0xe48bff56].forEach((value, i) =>
      put32(i, value),
    );
    put32(127, 0x0ab16f30);
    const boot2 = bytes.subarray(32, 32 + 252);
    boot2.set([0xfe, 0xe7]);
    words.setUint32(32 + 252, crcOfBoot2(boot2), true);
    return bytes;
  };
  test('starts a second-stage bootloader with the right sum, and no other', () => {
    assert.equal(bare([]).mcu.loadUF2, undefined, 'the bare package has none');
    for (const [flipped, waits] of [
      [null, false],
      [32, true],
      [32 + 252, true],
    ]) {
      const file = block();
      if (flipped !== null) file[flipped] ^= 1;
      const chip = new Chip();
      chip.flash.load(file);
      chip.powerOn();
      assert.equal(chip.waitsForUsb, waits);
      if (!waits) assert.equal(chip.mcu.core.PC, 0x20041f00);
    }
  });
  test('ignores a file that is not for it', () => {
    for (const [at, value, why] of [
      [0, 0, /magic/],
      [28, 1, /family/],
      [15, 0x20, /address/],
      [508, 0, /magic/],
    ]) {
      const file = block();
      file[at] = value;
      assert.throws(() => blocksOf(file), why);
    }
    assert.throws(() => blocksOf(new Uint8Array(500)), /512/);
  });
  test('erases and programs as a flash does: only to ones, only to zeros', () => {
    const {chip} = strict([]);
    chip.flash.program(0x1000, [0x0f]);
    chip.flash.program(0x1000, [0xf3]);
    assert.equal(chip.flash.bytes[0x1000], 0x03);
    chip.flash.erase(0x1000);
    assert.equal(chip.flash.bytes[0x1000], 0xff);
  });
  test('the flash tells its number, between commands', () => {
    const bytes = (mcu) => {
      for (let i = 0; i < 13; i++) mcu.writeUint32(0x18000060, i ? 0 : 0x4b);
      return Array.from({length: 13}, () => mcu.readUint32(0x18000060)).slice(5);
    };
    assert.ok(
      bytes(bare([]).mcu).every((byte) => byte === 0),
      'the bare package has no such command',
    );
    const {chip, mcu} = strict([]);
    mcu.writeUint32(0x18000008, 0);
    mcu.writeUint32(0x18000000, 0x00070000);
    mcu.writeUint32(0x18000008, 1);
    assert.deepEqual(bytes(mcu), [...chip.flash.id]);
  });
  test('a power that fails cuts a page short', () => {
    const {chip} = strict([]);
    chip.flash.powerFor = 2;
    chip.flash.program(0, [1, 2, 3, 4]);
    assert.deepEqual([...chip.flash.bytes.slice(0, 4)], [1, 2, 0xff, 0xff]);
    chip.run(chip.nanos + 8);
    assert.deepEqual(chip.resets, ['power', 'power']);
  });
  test('a core that reads the flash while it takes commands has a fault', () => {
    assert.equal(mail(bare([0x6801], {0: 0x10001000}).run(10)), 0);
    const there = strict([0x6801], {0: 0x10001000});
    there.mcu.writeUint32(0x18000008, 0);
    assert.equal(mail(there.run(60)), 3);
  });
});
