// The playground's Pico: the image that is flashed drives in a worker of the page, as it does in Node.js.
import assert from 'node:assert/strict';
import {copyFileSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {describe, test} from 'node:test';
import {driveOf} from '../../host/harness/pico/rig.mjs';
import {drawn} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {ROOT, whisker} from './scenarios.mjs';

const PAGE = process.env.PLAYGROUND ?? join(ROOT, 'out/playground/index.html');
const SEED = 31;
const WORLD = `#world=u-trap&seed=${SEED}&planner=pico`;
/** A computer is slow; in this time, the chip gets further on each. */
const STEP = {timeout: 120_000};
const ROBOT = join(ROOT, 'host/robots/pico.toml');

describe('a Pico in the playground', () => {
  const {folder, openPage} = inBrowser();
  const open = (options = {}, page = PAGE) =>
    openPage(`file://${page}${WORLD}`, {reducedMotion: 'reduce', ...options});
  const result = (page) => page.evaluate('window.whisker.play.runs[0].result');
  /** Until it is over or has driven so long; waits as long as the chip gets further. */
  const until = async (page, seconds) => {
    const ends = (time) => {
      const {play, chip} = window.whisker;
      return play.over || play.time > time || chip.fault !== '';
    };
    const late = (error) => assert.equal(error.name, 'TimeoutError', error.message);
    const look = () =>
      page.evaluate(() => {
        const {play, chip} = window.whisker;
        return {time: play.time, playing: play.playing, waits: chip.waits, fault: chip.fault};
      });
    let state = {time: -1};
    while (!(await page.waitForFunction(ends, seconds, STEP).catch(late))) {
      const {time} = state;
      state = await look();
      assert.ok(state.time > time, `stands still: ${JSON.stringify(state)}`);
    }
    assert.equal((await look()).fault, '');
  };
  const setPlaying = (page, on) => page.evaluate((to) => window.whisker.play.setPlaying(to), on);
  const driven = async (page, seconds) => {
    await setPlaying(page, true);
    await until(page, seconds);
    await setPlaying(page, false);
    await drawn(page);
  };
  const over = (page) => until(page, Infinity);
  const pin = (page, name) => page.textContent(`#pins tr:has(td:text-is("${name}")) td:last-child`);

  test('drives to the goal, with the commands of the same file in Node.js', async () => {
    const world = folder.at('u.toml');
    whisker('world', 'u-trap', '--seed', SEED, '--out', world);
    const {page, complaints} = await open();
    await page.click('#finish');
    await over(page);
    await drawn(page);
    const {outcome, time, hash, ticks} = await result(page);
    assert.equal(outcome, 'reached');
    const drive = driveOf([world, '--robot', ROBOT]);
    try {
      drive.until(Math.round(time * 1000), () => false);
      assert.equal(drive.commands, hash);
      const {answers, difference} = drive.rig.verdict();
      assert.equal(answers, ticks);
      assert.equal(difference, '');
    } finally {
      drive.close();
    }
    assert.match(await page.textContent('#card-0 .verdict'), /^reached the goal in/);
    assert.match(await page.textContent('#hashes'), new RegExp(`${hash}.*each answer is the core's`));
    assert.deepEqual(complaints, []);
  });

  test('its pins are seen', async () => {
    const {page, complaints} = await open();
    await driven(page, 4.2);
    assert.match(
      await pin(page, 'left sensor, I2C'),
      /^0x30: 2[0-9] measured, [0-9]{3,} transfers \/ s14 > /,
    );
    assert.match(await pin(page, 'gyro, I2C'), /not asked/);
    assert.equal(await pin(page, 'light'), 'on');
    assert.equal(await pin(page, 'motor driver'), 'awake');
    // At one time: the emulator may still be on its way to where the page has stopped.
    const {shown, count} = await page.evaluate(() => {
      const rows = [...document.querySelectorAll('#pins tr')];
      const row = rows.find(({textContent}) => textContent.includes('left encoder'));
      return {shown: row.lastChild.textContent, count: window.whisker.chip.told.pins.encoders[0].count};
    });
    assert.equal(shown, `AB ${count} counts`);
    assert.notEqual(count, 0);
    // One a tick; a second that is no whole number of ticks counts one more or less.
    assert.match(await page.textContent('#pins .console'), /101WheelCommand(99|10[01])/);
    assert.match(
      await page.textContent('#pins'),
      /This computer emulates [0-9.]+ seconds of the chip in a second/,
    );
    assert.deepEqual(complaints, []);
  });

  test('what is pulled out ends in its named fault, and in standstill', async () => {
    const {page} = await open();
    await driven(page, 4);
    await page.click('#pins button:text-is("Left sensor")');
    await page.click('#play');
    await over(page);
    await drawn(page);
    assert.equal((await result(page)).outcome, 'fault');
    assert.match(await page.textContent('#card-0 .what-now'), /The fault: a beam was lost/);
  });

  test('an obstacle may be put before it', async () => {
    const {page, complaints} = await open();
    await driven(page, 1);
    await page.click('#add-disc');
    await driven(page, 2);
    assert.equal(await page.evaluate('window.whisker.play.situation.world.discs.length'), 1);
    assert.equal((await result(page)).outcome, null);
    assert.deepEqual(complaints, []);
  });

  test('a page alone says what it lacks', async () => {
    const alone = folder.at('index.html');
    copyFileSync(PAGE, alone);
    const {page} = await open({}, alone);
    await page.waitForFunction(() => window.whisker.chip.fault !== '');
    await drawn(page);
    assert.match(await page.textContent('#card-0 .what-now'), /pico\.js is not beside this page/);
  });

  test('the notice of the emulator is in its file', () => {
    const text = readFileSync(PAGE.replace('index.html', 'pico.js'), 'latin1');
    assert.match(text.slice(0, 300), /rp2040js: .*MIT License/);
  });

  everybodyCanRead(async (options) => {
    const opened = await open(options);
    await driven(opened.page, 2.1);
    return opened;
  });
});
