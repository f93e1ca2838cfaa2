// What breaks at the pins and registers of a driving robot ends in its named fault and in standstill, which the simulator
// measures.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {describe, test} from 'node:test';
import {PINS} from '../../host/harness/pico/body.mjs';
import {Chip} from '../../host/harness/pico/chip.mjs';
import {driveOf} from '../../host/harness/pico/rig.mjs';
import {IMAGE} from '../../host/harness/pico/paths.mjs';
import {LONG, ROBOT, SONAR, atNight, robotWith, world} from './worlds.mjs';

const MOVES_UM_S = 20000;
const DRIVES_UM_S = 100000;
const LOOP = 0x20030000;
/** Of IO_BANK0: what the handler of the pins acknowledges. */
const INTR0 = 0xf0;
const PROC0_INTE0 = 0x100;
const MOST_LATE_NS = 10000; // 2 mm

/** A robot that has begun to move. */
function moving(robot = ROBOT) {
  const drive = driveOf([world('discs'), '--robot', robot]);
  assert.ok(
    drive.until(8000, ({ordered, speeds}) => ordered && speeds.some((speed) => Math.abs(speed) > MOVES_UM_S)),
    'it moves',
  );
  return drive;
}

/** Milliseconds from the fault until the wheels stand for good, within `ms`. */
function standstill(drive, ms) {
  const began = drive.ms;
  let stood = null;
  drive.until(ms, () => {
    if (!drive.stands) stood = null;
    else stood ??= drive.ms - began;
    return (
      stood !== null &&
      drive.ms - began - stood > 300 &&
      (drive.now.fault !== 'none' || drive.body.motors.asleep || drive.now.base !== 'running')
    );
  });
  return stood;
}

const sensor = (beam, fault) => (drive) => (drive.body.rangers[beam].fault = fault);
/** Its cable is cut on the way, while its echo line is high. */
const cutOff = (beam) => (drive) => {
  const ranger = drive.body.rangers[beam];
  assert.ok(drive.until(20000, ({speeds}) => ranger.high && speeds.every((speed) => speed > DRIVES_UM_S)));
  ranger.fault = 'unplugged';
};
const encoder = (wheel, fault) => (drive) => (drive.body.encoders[wheel].fault = fault);

// What breaks, the fault that it ends in, and the time in ms within which the wheels stand for good.
const broken = [
  ['an unplugged sensor', sensor(1, 'unplugged'), 'range_lost', 1200],
  ['a sensor that measures no more', sensor(0, 'dead'), 'range_lost', 1200],
  ['a laser that fails', sensor(2, 'laser'), 'range_lost', 1200],
  ['a short circuit of the bus', (drive) => drive.body.bus.hold(Infinity), 'range_lost', 1200],
  ['a dead encoder', encoder(0, 'dead'), 'wheels_stalled', 1200],
  ['an encoder with a broken channel', encoder(1, 'a'), 'wheels_stalled', 1200],
  ['an unplugged encoder', encoder(1, 'unplugged'), 'wheels_stalled', 1200],
  [
    'all sensors unplugged',
    (drive) => drive.body.rangers.forEach((ranger) => (ranger.fault = 'unplugged')),
    'range_lost',
    1200,
  ],
  ['an encoder with swapped channels', encoder(0, 'swapped'), 'wheel_runaway', 1200],
  ['a motor with swapped wires', (drive) => (drive.body.motors.swapped[1] = true), 'wheel_runaway', 1200],
  ['motors without power', (drive) => (drive.body.motors.stalled = [true, true]), 'wheels_stalled', 1200],
  ['a stalled motor', (drive) => (drive.body.motors.stalled[0] = true), 'wheels_stalled', 1200],
  ['an HC-SR04 that is cut off on the way', cutOff(1), 'range_lost', 900, SONAR],
  ['an HC-SR04 whose echo line is held high', sensor(0, 'held'), 'range_lost', 900, SONAR],
  ['an HC-SR04 that locks up after a ping', sensor(1, 'locked'), 'range_lost', 900, SONAR],
  ['an HC-SR04 without its trigger', sensor(2, 'deaf'), 'range_lost', 900, SONAR],
  [
    'all HC-SR04 without power',
    (drive) => drive.body.rangers.forEach((ranger) => (ranger.fault = 'unplugged')),
    'range_lost',
    900,
    SONAR,
  ],
];

/** One fault of a kind. */
const BY_DAY = [
  'an unplugged sensor',
  'a short circuit of the bus',
  'a stalled motor',
  'a motor with swapped wires',
  'an HC-SR04 whose echo line is held high',
];

describe('of a driving robot', () => {
  for (const [what, breaks, fault, within, robot] of broken.filter(
    ([what]) => LONG || BY_DAY.includes(what),
  )) {
    test(`${what}: ${fault}`, () => {
      const drive = moving(robot);
      try {
        breaks(drive);
        const stood = standstill(drive, within + 1500);
        assert.equal(drive.now.fault, fault);
        assert.equal(drive.now.contact, false);
        assert.ok(stood !== null && stood <= within, `it stands after ${stood} ms`);
        assert.deepEqual(drive.chip.sins, []);
      } finally {
        drive.close();
      }
    });
  }

  test('a device that holds the bus in the midst of a byte: freed by clocks, and the drive goes on', () => {
    const drive = moving();
    try {
      const before = drive.body.rangers.map((ranger) => ranger.measurements);
      drive.body.bus.hold(5);
      drive.until(300, () => false);
      assert.equal(drive.body.bus.heldFor, 0);
      drive.body.rangers.forEach((ranger, beam) => assert.ok(ranger.measurements > before[beam] + 4));
      assert.equal(drive.now.fault, 'none');
    } finally {
      drive.close();
    }
  });
  atNight('edges of echo lines are timed while the bus of the gyro is freed', () => {
    const drive = moving(robotWith('gyro = true\n', '', SONAR));
    try {
      const {mcu} = drive.chip;
      const echo = mcu.gpio[PINS.echoes[0]];
      const late = [];
      let edge = null;
      mcu.gpio[PINS.clock].addListener(() => {
        edge ??= mcu.clock.nanos;
        echo.setInputValue(!echo.inputValue);
      });
      const io = mcu.peripherals[0x40014];
      const store = io.writeUint32Atomic;
      io.writeUint32Atomic = (offset, value, kind) => {
        if (offset >= INTR0 && offset < PROC0_INTE0 && edge !== null) {
          late.push(mcu.clock.nanos - edge);
          edge = null;
        }
        store(offset, value, kind);
      };
      drive.body.bus.hold(Infinity);
      drive.until(300, () => false);
      assert.ok(late.length > 20, `${late.length} edges`);
      const worst = Math.max(...late);
      assert.ok(worst < MOST_LATE_NS, `${worst} ns late`);
    } finally {
      drive.close();
    }
  });
  atNight('a sensor whose supply fails for a moment: started anew, and the drive goes on', () => {
    const drive = moving();
    try {
      const before = drive.body.rangers[2].measurements;
      drive.body.rangers[2].glitch();
      drive.until(900, () => false);
      assert.ok(drive.body.rangers[2].measurements > before + 5);
      assert.equal(drive.now.fault, 'none');
    } finally {
      drive.close();
    }
  });
  test('an E-stop on the cable', () => {
    const drive = moving();
    try {
      drive.body.mcu.uart[0].feed(Buffer.from('t0110\r'));
      const stood = standstill(drive, 1500);
      assert.equal(drive.now.base, 'e_stopped');
      assert.ok(stood <= 700, `it stands after ${stood} ms`);
    } finally {
      drive.close();
    }
  });
  atNight('noise on the cable: nothing', () => {
    const drive = moving();
    try {
      let state = 7;
      for (let ms = 0; ms < 400; ms++) {
        const bytes = Array.from(
          {length: 90},
          () => (state = (Math.imul(state, 1103515245) + 12345) >>> 0) >>> 24,
        );
        drive.body.mcu.uart[0].feed(bytes.filter((byte) => byte !== 0x74 && byte !== 0x54));
        drive.step();
      }
      assert.equal(drive.now.fault, 'none');
      assert.equal(drive.now.base, 'running');
      assert.ok(!drive.stands);
    } finally {
      drive.close();
    }
  });
  atNight('a supply that fails for a moment: it stands, and rests after its start', () => {
    const drive = moving();
    try {
      drive.chip.losePower();
      const stood = standstill(drive, 1500);
      assert.ok(stood <= 500, `it stands after ${stood} ms`);
      assert.deepEqual(drive.chip.resets, ['power', 'power']);
      drive.until(1500, () => false);
      assert.ok(drive.stands);
      assert.deepEqual(drive.chip.sins, []);
    } finally {
      drive.close();
    }
  });
  test('a dead gyro: the wheels turn the pose, and the drive goes on', () => {
    const drive = moving(robotWith('gyro = true\n'));
    try {
      assert.ok(drive.rig.verdict().turned_by_gyro);
      drive.body.gyro.fault = 'dead';
      drive.until(1000, () => false);
      assert.equal(drive.rig.verdict().turned_by_gyro, false);
      assert.equal(drive.now.fault, 'none');
      assert.ok(drive.body.gyro.resets >= 2, 'it was started again');
      drive.body.gyro.fault = null;
      assert.ok(drive.until(6000, () => drive.ms % 100 === 0 && drive.rig.verdict().turned_by_gyro));
    } finally {
      drive.close();
    }
  });
  atNight('a bump: it stops and backs off', () => {
    const drive = moving(robotWith('bumper = true\n'));
    try {
      drive.body.bump(0, true);
      const stood = drive.until(700, () => drive.stands);
      assert.ok(stood, 'it stops');
      assert.equal(drive.rig.verdict().why, 'bumped');
      drive.until(300, () => false);
      drive.body.bump(0, false);
      drive.until(500, () => false);
      assert.equal(drive.now.fault, 'none');
    } finally {
      drive.close();
    }
  });
  atNight('a bump switch that stays closed: bumper_stuck', () => {
    const drive = moving(robotWith('bumper = true\n'));
    try {
      drive.body.bump(1, true);
      assert.ok(
        drive.until(15000, ({fault}) => fault === 'bumper_stuck'),
        drive.now.fault,
      );
      drive.until(800, () => false);
      assert.ok(drive.stands);
    } finally {
      drive.close();
    }
  });
  test('a cut cable: the mission goes on, and a new cable hears it', () => {
    const drive = moving();
    try {
      drive.body.connect(false);
      drive.until(500, () => false);
      const silent = drive.rig.verdict().frames;
      drive.body.connect(true);
      drive.until(200, () => false);
      assert.ok(drive.rig.verdict().frames > silent + 50);
      assert.equal(drive.now.fault, 'none');
      assert.equal(drive.now.base, 'running');
    } finally {
      drive.close();
    }
  });
  test('a program that hangs: the watchdog resets it, and the motor driver sleeps', () => {
    const drive = moving();
    try {
      drive.chip.mcu.sramView.setUint16(LOOP - 0x20000000, 0xe7fe, true);
      drive.chip.mcu.core.PC = LOOP;
      drive.chip.mcu.core.PM = true;
      const stood = standstill(drive, 1500);
      assert.deepEqual(drive.chip.resets, ['power', 'watchdog']);
      assert.ok(stood <= 700, `it stands after ${stood} ms`);
    } finally {
      drive.close();
    }
  });
  test('a fault of the processor: the motor driver sleeps at once', () => {
    const drive = moving();
    try {
      drive.chip.mcu.core.PC = 0x60000000;
      drive.step();
      assert.ok(drive.body.motors.asleep);
      const stood = standstill(drive, 1500);
      assert.ok(stood <= 500, `it stands after ${stood} ms`);
      assert.deepEqual(drive.chip.resets, ['power', 'watchdog']);
      assert.equal(drive.chip.faults.length, 1);
    } finally {
      drive.close();
    }
  });
});

/** The first bytes of an image are boot 2, and the blocks of the file have 32 bytes before their page. */
function damaged(flash) {
  const file = readFileSync(IMAGE);
  file[Math.floor(flash / 256) * 512 + 32 + (flash % 256)] ^= 1;
  const chip = new Chip();
  chip.flash.load(file);
  let flashes = 0;
  chip.attach({plug: (mcu) => mcu.gpio[25].addListener((value) => (flashes += value === 1 ? 1 : 0))});
  chip.powerOn();
  chip.run(400e6);
  return {chip, flashes: () => flashes, asleep: !chip.mcu.gpio[20].outputValue};
}

describe('at the start', () => {
  const starts = (prepare) => driveOf([world('discs'), '--robot', ROBOT, '--listen'], {prepare});
  atNight('a sensor that is not there: range_lost, and no motion', () => {
    const drive = starts(() => {});
    try {
      drive.body.rangers[0].fault = 'unplugged';
      assert.ok(drive.until(6000, ({fault}) => fault === 'range_lost'));
      assert.ok(drive.rig.verdict().path_m < 1e-3);
    } finally {
      drive.close();
    }
  });
  test('HC-SR04 before the parameters say so: range_lost, and no motion', () => {
    const drive = driveOf([world('discs'), '--robot', SONAR, '--listen']);
    try {
      assert.ok(drive.until(6000, ({fault}) => fault === 'range_lost'));
      assert.ok(drive.rig.verdict().path_m < 1e-3);
    } finally {
      drive.close();
    }
  });
  test('a press of the button sends it ahead, and another one stops it', () => {
    const drive = starts(() => {});
    const press = () => {
      drive.body.press(true);
      drive.until(150, () => false);
      drive.body.press(false);
    };
    try {
      drive.until(1500, () => false);
      press();
      assert.ok(drive.until(4000, () => !drive.stands));
      press();
      assert.ok(drive.until(1500, () => drive.stands));
      drive.until(300, () => false);
      assert.ok(drive.stands);
      assert.equal(drive.now.fault, 'none');
    } finally {
      drive.close();
    }
  });
  atNight('a button that is down: no press', () => {
    const drive = starts(() => {});
    try {
      drive.body.press(true);
      drive.until(2500, () => false);
      assert.ok(drive.rig.verdict().path_m < 1e-3);
      assert.equal(drive.now.base, 'running');
    } finally {
      drive.close();
    }
  });
  test('a crystal that does not start: it flashes, and the motor driver sleeps', () => {
    const chip = new Chip();
    chip.flash.load(readFileSync(IMAGE));
    chip.crystalDead = true;
    let flashes = 0;
    chip.attach({plug: (mcu) => mcu.gpio[25].addListener((value) => (flashes += value === 1 ? 1 : 0))});
    chip.powerOn();
    chip.run(3e9);
    assert.ok(flashes >= 2, `${flashes} flashes`);
    assert.ok(!chip.mcu.gpio[20].outputValue);
  });
});

describe('of an image', () => {
  test('a flipped bit of the second-stage bootloader: it waits for another image', () => {
    assert.ok(damaged(17).chip.waitsForUsb);
  });
  test('a flipped bit anywhere else: it flashes, and never drives', () => {
    for (const at of LONG ? [0x1d0, 40000, 180000] : [40000]) {
      const {chip, flashes, asleep} = damaged(at);
      assert.ok(asleep);
      chip.run(1e9);
      assert.ok(flashes() >= 2, `${flashes()} flashes`);
    }
  });
});

const SLOTS = [0x200000 - 2 * 8192, 0x200000 - 8192]; // hal/boards/pico/flash_storage.cpp: the last of its uses

function crc32(bytes) {
  let crc = -1;
  for (const byte of bytes) {
    crc ^= byte;
    for (let i = 0; i < 8; i++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** The values of the newest whole record of the parameters, or null. */
function kept(flash) {
  let newest = null;
  for (const slot of SLOTS) {
    const words = new DataView(flash.bytes.buffer, slot, 8192);
    const size = 8 + 4 * words.getUint8(1) + 4;
    if (size > 8192 || crc32(flash.bytes.subarray(slot, slot + size - 4)) !== words.getUint32(size - 4, true))
      continue;
    const sequence = words.getUint16(2, true);
    if (newest === null || sequence > newest.sequence)
      newest = {
        sequence,
        values: Buffer.from(flash.bytes.subarray(slot + 8, slot + size - 4)).toString('hex'),
      };
  }
  return newest;
}

/** Until the operator's parameters are kept, or there is no hope. */
function commits(flash, speed) {
  const robot = robotWith(`wheel_speed_max_mps = ${speed}`, 'wheel_speed_max_mps = 0.3');
  const prepare = (chip) => {
    chip.flash.bytes.set(flash.bytes.subarray(SLOTS[0]), SLOTS[0]);
    chip.flash.powerFor = flash.powerFor;
    chip.flash.worn = flash.worn;
  };
  const drive = driveOf([world('discs'), '--robot', robot], {prepare});
  try {
    drive.until(2000, ({ordered}) => ordered || drive.chip.resets.length > 1);
    return {flash: drive.chip.flash, resets: drive.chip.resets};
  } finally {
    drive.close();
  }
}

describe('of the flash', () => {
  const blank = {bytes: new Uint8Array(0x200000).fill(0xff), powerFor: Infinity, worn: new Set()};
  test('a power that fails while parameters are kept leaves the old ones or the new ones', () => {
    const first = commits(blank, 0.3).flash;
    const old = kept(first);
    assert.ok(old, 'the first ones are kept');
    const fresh = kept(commits({...blank, bytes: first.bytes}, 0.25).flash);
    assert.notEqual(fresh.values, old.values);
    for (const powerFor of LONG ? [1, 5000, 8192 + 7, 8192 + 300] : [5000, 8192 + 7]) {
      const {flash, resets} = commits({...blank, bytes: first.bytes, powerFor}, 0.25);
      assert.deepEqual(resets, ['power', 'power']);
      assert.ok([old.values, fresh.values].includes(kept(flash)?.values), `cut after ${powerFor} bytes`);
    }
  });
  test('a worn sector keeps nothing wrong', () => {
    const {flash} = commits({...blank, worn: new Set([SLOTS[0], SLOTS[1]])}, 0.25);
    assert.equal(kept(flash), null);
  });
});
