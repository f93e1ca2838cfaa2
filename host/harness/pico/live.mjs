// usage: node host/harness/pico/live.mjs WORLD [ROBOT]
//
// The robot in a world, in real time. The port of its USB cable is file descriptor 3, which does not block; scripts/pico opens
// it. Lines of standard input: `button` or `hold` presses the button, briefly or for 1.5 s; `hand N` holds a hand before
// sensor 0, 1 or 2, `hand` takes it away; `wheel N COUNTS` turns wheel 0 or 1 forward by hand.
import {readSync, writeSync} from 'node:fs';
import {createInterface} from 'node:readline';
import {join} from 'node:path';
import {ROOT} from './paths.mjs';
import {driveOf} from './rig.mjs';

const CABLE = 3;
const SLICE_MS = 20;
const LONGEST_MS = 50;
const BRIEF_MS = 200;
const HELD_MS = 1500;

const [world, robot = join(ROOT, 'host/robots/pico.toml')] = process.argv.slice(2);
// Before the simulator starts: it would wait for ever for a process that is gone.
for (const signal of ['SIGINT', 'SIGTERM'])
  process.on(signal, () => {
    drive.close();
    process.exit(0);
  });
const drive = driveOf([world, '--robot', robot, '--listen'], {
  seed: Date.now() & 0xffffffff,
  usb: true,
});
const buffer = Buffer.alloc(4096);

/** What has come; nothing, while nobody has opened the other end. */
function read() {
  try {
    return buffer.subarray(0, readSync(CABLE, buffer));
  } catch {
    return buffer.subarray(0, 0);
  }
}

function write(bytes) {
  try {
    writeSync(CABLE, Buffer.from(bytes));
  } catch {
    // Nobody reads: a serial line loses it.
  }
}

drive.takesBytes = (bytes) => {
  if (bytes.length) write(bytes);
};
let releaseAt = Infinity;
const press = (ms) => {
  drive.body.press(true);
  releaseAt = drive.ms + ms;
};
const lines = {
  button: () => press(BRIEF_MS),
  hold: () => press(HELD_MS),
  hand: (beam) => (drive.body.hand = beam === undefined ? null : Number(beam)),
  wheel: (wheel, counts) => (drive.body.turns[wheel] = Number(counts)),
};
createInterface({input: process.stdin}).on('line', (line) => {
  const [word, ...values] = line.trim().split(' ');
  if (lines[word] === undefined) return console.log(Object.keys(lines).join(', '));
  lines[word](...values);
});

const began = Date.now();
let said = '';
let lost = 0;
function slice() {
  // On a computer that is too slow, the robot's time is longer.
  const behind = Date.now() - began - lost - drive.ms;
  if (behind > LONGEST_MS) lost += behind - LONGEST_MS;
  drive.body.tell(read());
  for (const due = Date.now() - began - lost; drive.ms < due;) {
    if (drive.ms >= releaseAt) {
      drive.body.press(false);
      releaseAt = Infinity;
    }
    drive.step();
  }
  const state = `${(drive.ms / 1000).toFixed(0).padStart(4)} s: light ${drive.body.led ? 'on' : 'off'}, wheels ${drive.now.speeds.map((speed) => (speed / 1e6).toFixed(2)).join(' ')} m/s${drive.now.contact ? ', CONTACT' : ''}`;
  if (process.env.WHISKER_PICO_TELLS && state.slice(0, 6) !== said.slice(0, 6)) console.log(state);
  said = state;
  setTimeout(slice, SLICE_MS);
}
slice();
