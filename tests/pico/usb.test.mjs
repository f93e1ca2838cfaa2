// The image's USB serial port at a strict host: what it says of itself, what it refuses, and what becomes of a drive.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {describe, test} from 'node:test';
import {Chip} from '../../host/harness/pico/chip.mjs';
import {IMAGE} from '../../host/harness/pico/paths.mjs';
import {driveOf} from '../../host/harness/pico/rig.mjs';
import {UsbHost, setupOf} from '../../host/harness/pico/usb_host.mjs';
import {ROBOT, atNight, world} from './worlds.mjs';

const MS = 1e6;
const MOVES_UM_S = 20000;
const MOST_CYCLES = 1_250_000;
const NONE = null; // a STALL

/** The image at a host, without a body; it has enumerated. */
function enumerated({seed = 1, open = true} = {}) {
  const chip = new Chip({seed});
  chip.flash.load(readFileSync(IMAGE));
  const host = chip.attach(new UsbHost({plugged: true}));
  host.open = open;
  let text = '';
  host.onByte = (byte) => (text += String.fromCharCode(byte));
  chip.powerOn();
  const run = (ms) => chip.run(chip.nanos + ms * MS);
  const ask = (setup, data) => {
    let answer = 'none';
    host.request(setup, (bytes) => (answer = bytes && [...bytes]), data);
    run(20);
    return answer;
  };
  const good = () => assert.deepEqual([chip.sins, chip.faults, host.complaints], [[], [], []]);
  run(400);
  return {chip, host, run, ask, good, said: () => text, forget: () => (text = '')};
}

const DEVICE = [18, 1, 0, 2, 0xef, 2, 1, 64, 0x09, 0x12, 1, 0, 0, 1, 1, 2, 3, 1];
const describeAs = (kind, number, length, language = 0) =>
  setupOf(0x80, 6, (kind << 8) | number, language, length);

describe('the USB port', () => {
  test('is what its descriptors say, to a strict host', () => {
    const {host, good, said, run} = enumerated();
    const {serial, ...device} = host.device;
    assert.deepEqual(device, {
      vendor: 0x1209,
      product: 1,
      maker: 'Whisker',
      name: 'Whisker robot',
      value: 1,
      milliamperes: 250,
      control: 0,
      in: 2,
      out: 2,
    });
    assert.equal(serial, 'E660583800000001');
    assert.notEqual(enumerated({seed: 2}).host.device.serial, serial);
    run(100);
    assert.match(said(), /^(z?\r)*t[0-9A-F]+\r/);
    good();
  });
  test('gives no more than is asked, and no less than there is', () => {
    const {ask, good} = enumerated();
    for (const [kind, all] of [
      [1, 18],
      [2, 75],
    ])
      for (const length of [1, 8, 9, 18, 63, 64, 65, 74, 75, 76, 128, 255, 0x1000])
        assert.equal(
          ask(describeAs(kind, 0, length))?.length,
          Math.min(all, length),
          `${kind}, ${length} bytes`,
        );
    assert.deepEqual(ask(describeAs(1, 0, 64)), DEVICE);
    assert.deepEqual(ask(describeAs(3, 0, 255)), [4, 3, 9, 4]);
    assert.deepEqual(ask(describeAs(3, 2, 2, 0x0409)), [28, 3]);
    assert.deepEqual(ask(describeAs(1, 0, 0)), []);
    good();
  });
  test('answers a wrong request with a STALL, and the next one all the same', () => {
    const {ask, good} = enumerated();
    const wrong = {
      'a descriptor that it does not have': describeAs(6, 0, 10),
      'a capability of USB 3': describeAs(15, 0, 5),
      'a string that it does not have': describeAs(3, 4, 255, 0x0409),
      'the string that Windows asks for': describeAs(3, 0xee, 18),
      'another configuration': describeAs(2, 1, 9),
      'to choose another configuration': setupOf(0x00, 9, 2),
      'an address that is none': setupOf(0x00, 5, 128),
      'to wake the host': setupOf(0x00, 3, 1),
      'to write a descriptor': setupOf(0x00, 7, 0x100),
      'the status of an interface that it does not have': setupOf(0x81, 0, 0, 2, 2),
      'the status of an endpoint that it does not have': setupOf(0x82, 0, 0, 0x83, 2),
      'a halt of an endpoint that it does not have': setupOf(0x02, 3, 0, 0x01),
      'another feature of an endpoint': setupOf(0x02, 1, 1, 0x82),
      'another setting of an interface': setupOf(0x01, 11, 1, 1),
      'a line coding of the interface for data': setupOf(0xa1, 0x21, 0, 1, 7),
      'a line coding without bytes': setupOf(0x21, 0x20),
      'a request of a modem': setupOf(0x21, 0x02),
      'a request of a vendor': setupOf(0xc0, 1, 0, 0, 8),
    };
    for (const [what, setup] of Object.entries(wrong)) {
      assert.equal(ask(setup), NONE, what);
      assert.deepEqual(ask(describeAs(1, 0, 18)), DEVICE, `after ${what}`);
    }
    assert.equal(ask(setupOf(0x21, 0x20, 0, 0, 6), [0, 0, 0, 0, 0, 0]), NONE, 'a short line coding');
    good();
  });
  test('answers all that a host may ask', () => {
    const {ask, good} = enumerated();
    assert.deepEqual(ask(setupOf(0x80, 0, 0, 0, 2)), [0, 0]);
    assert.deepEqual(ask(setupOf(0x80, 8, 0, 0, 1)), [1]);
    assert.deepEqual(ask(setupOf(0x81, 0, 0, 1, 2)), [0, 0]);
    assert.deepEqual(ask(setupOf(0x81, 10, 0, 1, 1)), [0]);
    assert.deepEqual(ask(setupOf(0x82, 0, 0, 0x81, 2)), [0, 0]);
    assert.deepEqual(ask(setupOf(0x82, 0, 0, 0x80, 2)), [0, 0]);
    assert.deepEqual(ask(setupOf(0x02, 1, 0, 0)), []);
    assert.deepEqual(ask(setupOf(0x21, 0x23, 100)), [], 'a break');
    const coding = [0x00, 0x10, 0x0e, 0x00, 0, 2, 7];
    assert.deepEqual(ask(setupOf(0x21, 0x20, 0, 0, 7), coding), []);
    assert.deepEqual(ask(setupOf(0xa1, 0x21, 0, 0, 7)), coding);
    good();
  });
  test('a request that is given up leaves nothing behind', () => {
    const {host, ask, good, run} = enumerated();
    for (const given of [describeAs(2, 0, 75), setupOf(0x21, 0x20, 0, 0, 7), setupOf(0x00, 5, 99)])
      for (const wait of [0, 1]) {
        host.abandon(given);
        run(wait);
        assert.deepEqual(ask(describeAs(1, 0, 18)), DEVICE);
        assert.deepEqual(ask(setupOf(0x80, 8, 0, 0, 1)), [1]);
      }
    good();
  });
  test('an endpoint that is halted, and no longer', () => {
    const {host, ask, run, good, said, forget} = enumerated();
    for (const [address, way] of [
      [0x82, 'in'],
      [0x02, 'out'],
      [0x81, null],
    ]) {
      const status = () => ask(setupOf(0x82, 0, 0, address, 2));
      assert.deepEqual(ask(setupOf(0x02, 3, 0, address)), []);
      assert.deepEqual(status(), [1, 0]);
      run(50);
      forget();
      if (way === 'out') host.feed([...'V\r'].map((c) => c.charCodeAt(0)));
      run(50);
      assert.equal(said().includes('V0101'), false);
      if (way === 'in') assert.equal(said(), '');
      host.request(setupOf(0x02, 1, 0, address), () => way && (host.toggles[way] = false));
      run(50);
      assert.deepEqual(status(), [0, 0]);
      assert.match(said(), way === 'out' ? /V0101\r/ : /t[0-9A-F]+\r/);
    }
    good();
  });
  test('says nothing while no program has it open', () => {
    const {host, run, said, good} = enumerated({open: false});
    run(300);
    assert.equal(said(), '');
    host.setOpen(true);
    run(300);
    assert.match(said(), /^t[0-9A-F]+\r/, 'from the start of a line');
    good();
  });
  test('a host that sleeps, and wakes', () => {
    const {host, run, said, good, forget} = enumerated();
    host.sleep(true);
    run(50);
    forget();
    run(200);
    assert.equal(said(), '');
    host.sleep(false);
    run(200);
    assert.match(said(), /t[0-9A-F]+\r/);
    good();
  });
  test('without its clock, the robot runs, and no host sees it', () => {
    const chip = new Chip();
    chip.flash.load(readFileSync(IMAGE));
    chip.usbClockDead = true;
    const host = chip.attach(new UsbHost({plugged: true}));
    let heard = 0;
    chip.attach({plug: (mcu) => (mcu.uart[0].onByte = () => ++heard)});
    chip.powerOn();
    chip.run(500 * MS);
    assert.ok(heard > 1000, 'the serial line talks');
    assert.equal(host.enumerations, 0);
    assert.deepEqual([chip.sins, chip.faults, host.complaints], [[], [], []]);
  });
  test('comes back after a reset of the chip', () => {
    const {chip, host, run, said, good, forget} = enumerated();
    chip.losePower();
    run(500);
    forget();
    run(50);
    assert.equal(host.enumerations, 2);
    assert.match(said(), /t[0-9A-F]+\r/);
    good();
  });
});

/** A robot that has got its parameters and its goal by USB, and has begun to move. */
function moving() {
  const drive = driveOf([world('discs'), '--robot', ROBOT], {usb: true});
  assert.ok(
    drive.until(8000, ({ordered, speeds}) => ordered && speeds.some((speed) => Math.abs(speed) > MOVES_UM_S)),
    'it moves',
  );
  return drive;
}

/** It is on its way to its goal, as if nothing had been. */
function goesOn(drive) {
  assert.equal(drive.now.fault, 'none');
  assert.ok(!drive.body.motors.asleep);
  const worst = Math.max(...drive.body.ticks);
  assert.ok(worst < MOST_CYCLES, `a tick of ${worst} cycles`);
  assert.deepEqual([drive.chip.sins, drive.chip.faults, drive.body.usb.complaints], [[], [], []]);
  assert.deepEqual(drive.chip.resets, ['power']);
}

function arrives(drive) {
  assert.ok(drive.until(30000, ({outcome}) => outcome === 'reached'));
  const {contact, distance_m} = drive.rig.verdict();
  assert.equal(contact, false);
  assert.ok(distance_m < 0.1);
  goesOn(drive);
}

/** Frames that the other end hears in 200 ms. */
function heard(drive) {
  const before = drive.rig.verdict().frames;
  drive.until(200, () => false);
  return drive.rig.verdict().frames - before;
}

function driven(what, use, when = test) {
  when(what, () => {
    const drive = moving();
    try {
      use(drive);
    } finally {
      drive.close();
    }
  });
}

describe('of a robot that is driven by USB', () => {
  driven(
    'a host that does not read: the drive goes on',
    (drive) => {
      drive.body.usb.setReading(false);
      drive.until(1500, () => false);
      assert.equal(heard(drive), 0);
      goesOn(drive);
      drive.body.usb.setReading(true);
      assert.ok(heard(drive) > 50);
      arrives(drive);
    },
    atNight,
  );
  driven(
    'a cable that is pulled out: the mission goes on, and a new cable hears it',
    (drive) => {
      drive.body.connect(false);
      drive.until(1000, () => false);
      assert.equal(heard(drive), 0);
      goesOn(drive);
      drive.body.connect(true);
      drive.until(400, () => false);
      assert.equal(drive.body.usb.enumerations, 2);
      assert.ok(heard(drive) > 50);
      arrives(drive);
    },
    atNight,
  );
  driven(
    'a reset of the bus: the mission goes on, and the host finds it again',
    (drive) => {
      drive.body.usb.reset();
      drive.until(200, () => false);
      assert.equal(drive.body.usb.enumerations, 2);
      assert.ok(heard(drive) > 50);
      arrives(drive);
    },
    atNight,
  );
  driven(
    'an E-stop by the serial line beside it',
    (drive) => {
      const [uart] = drive.body.mcu.uart;
      uart.connected = true;
      uart.feed(Buffer.from('t0110\r'));
      assert.ok(drive.until(700, () => drive.stands));
      drive.until(300, () => false);
      assert.ok(drive.stands);
      assert.equal(drive.now.base, 'e_stopped');
    },
    atNight,
  );
  driven('an E-stop by USB', (drive) => {
    drive.body.tell(Buffer.from('t0110\r'));
    assert.ok(drive.until(700, () => drive.stands));
    drive.until(300, () => false);
    assert.ok(drive.stands);
    assert.equal(drive.now.base, 'e_stopped');
  });
});
