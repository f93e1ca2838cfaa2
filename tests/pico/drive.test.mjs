// The image that is flashed drives to the goal. Every answer of its core is compared with that of a core on this
// computer, for the same readings and times.
import assert from 'node:assert/strict';
import {after, describe, test} from 'node:test';
import {driveOf} from '../../host/harness/pico/rig.mjs';
import {LONG, ROBOT, SONAR, generated, robotWith, world} from './worlds.mjs';

const MOST_STACK = 3072;
const MOST_CYCLES = 1_250_000; // a period at 125 MHz
const FIRST_COMMAND_MS = 100;
const LONGEST_MS = 300000;

const TURN_MS = 19.9;
const LONGEST_TURN_MS = 30; // it waits for the end of a tick
const DRIVES_MS = 3000;

const figures = [];

/** Since the parameters hold, one sonar after another has pinged. */
function takesTurns(sonars, end) {
  const pings = sonars
    .flatMap(({pings}, beam) => pings.map((nanos) => ({ms: nanos / 1e6, beam})))
    .filter(({ms}) => ms > DRIVES_MS)
    .sort((a, b) => a.ms - b.ms);
  pings.slice(1).forEach(({ms, beam}, i) => {
    const turn = ms - pings[i].ms;
    assert.equal(beam, (pings[i].beam + 1) % 3);
    assert.ok(turn >= TURN_MS && turn < LONGEST_TURN_MS, `a turn of ${turn} ms`);
  });
  figures.push(`a turn of the sonars: ${((end - DRIVES_MS) / pings.length).toFixed(1)} ms`);
}

describe('the image of the Pico', () => {
  const robots = [['discs', ROBOT]];
  // At night, also HC-SR04, longer ways, USB, a gyro, and worlds of the generator.
  const FULL = ', with a gyro and a bumper';
  if (LONG)
    robots.push(
      ['discs', SONAR, ', with HC-SR04'],
      ['u_trap', ROBOT],
      ['room', ROBOT],
      ['u_trap', ROBOT, ', over USB', {usb: true}],
      ['discs', robotWith('gyro = true\nbumper = true\n'), FULL],
      ['room', SONAR, ', with HC-SR04'],
    );
  for (const kind of LONG ? ['discs', 'u-trap', 'rooms'] : [])
    for (const seed of [4, 5, 6]) robots.push([generated(kind, seed), ROBOT]);
  for (const [name, robot, extra = '', options = {}] of robots) {
    test(`drives to the goal: ${name}${extra}`, () => {
      const drive = driveOf([world(name), '--robot', robot], options);
      try {
        let running = false;
        drive.until(LONGEST_MS, (now) => {
          running ||= now.ordered && now.outcome === 'running';
          return (
            now.contact || now.fault !== 'none' || (running && now.outcome !== 'running' && drive.stands)
          );
        });
        const verdict = drive.rig.verdict();
        assert.equal(verdict.outcome, 'reached', JSON.stringify(verdict));
        assert.equal(verdict.contact, false);
        assert.ok(verdict.distance_m < 0.1, `${verdict.distance_m} m from the goal`);
        assert.equal(verdict.difference, '');
        assert.equal(verdict.turned_by_gyro, extra === FULL);
        if (robot === SONAR) takesTurns(drive.body.rangers, drive.ms);
        assert.ok(verdict.answers > 500);
        assert.deepEqual(drive.chip.sins, []);
        assert.deepEqual(drive.chip.faults, []);
        assert.deepEqual(drive.body.usb.complaints, []);
        assert.equal(drive.body.usb.enumerations, options.usb ? 1 : 0);
        assert.deepEqual(drive.chip.resets, ['power']);
        const worst = Math.max(...drive.body.ticks);
        assert.ok(worst < MOST_CYCLES, `a tick of ${worst} cycles`);
        assert.ok(drive.stack < MOST_STACK, `${drive.stack} bytes of stack`);
        assert.ok(drive.firstCommandMs < FIRST_COMMAND_MS, `${drive.firstCommandMs} ms to the first command`);
        const mean = drive.body.ticks.reduce((sum, cycles) => sum + cycles, 0) / drive.body.ticks.length;
        figures.push(
          `${name}${extra}: ${verdict.answers} answers alike, tick ${Math.round(mean)} cycles, worst ${worst} (${(worst / 125000).toFixed(1)} ms), stack ${drive.stack} bytes, first command after ${drive.firstCommandMs} ms`,
        );
      } finally {
        drive.close();
      }
    });
  }
  after(() => console.log(figures.join('\n')));
});
