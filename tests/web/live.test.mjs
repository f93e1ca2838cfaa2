// A run on a bus, watched in a browser while it goes on.
import assert from 'node:assert/strict';
import {spawn} from 'node:child_process';
import {once} from 'node:events';
import {readFileSync, writeFileSync} from 'node:fs';
import {connect, createServer} from 'node:net';
import {join} from 'node:path';
import {afterEach, describe, test} from 'node:test';
import {drawn, pictureOf, tickOf} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {ROOT, Running, whisker} from './scenarios.mjs';

// Lost frames are sent again after a while: the run takes some seconds, and is the same run.
const SLOW = ['--drop', 1];

const ticksOf = (page) => page.evaluate(() => window.whisker?.run.ticks ?? 0);
const grown = (page, than) => page.waitForFunction((n) => window.whisker?.run.ticks > n, than);
const state = (page, word) =>
  page.waitForFunction((w) => document.getElementById('live').dataset.state === w, word);

describe('the live page', () => {
  const {folder, openPage} = inBrowser(() => {
    alone = folder.drive('trap', ['u-trap', '--seed', 7]);
    whisker('world', 'rooms', '--seed', 3, '--out', rooms);
  });
  const all = [];
  let alone;
  const trap = folder.at('trap.toml');
  const rooms = folder.at('rooms.toml');
  afterEach(() => Promise.all(all.splice(0).map((one) => one.stop('SIGKILL'))));
  const start = (command, scenario, ...options) => {
    const planner = command === 'hil' ? ['--planner', 'skirt'] : [];
    const one = new Running(command, scenario, '--view', 0, '--json', ...planner, ...options);
    all.push(one);
    return one;
  };
  /** Minutes on the road: nothing ends before it is told to. */
  const startLong = () => start('hil', rooms, '--realtime');
  const watch = async (one, options = {}) => {
    const server = await one.url();
    return openPage(server + (options.hash ?? ''), {server, ...options});
  };
  /** All ticks are there, each once and in order, and they are those of the run. */
  const assertWhole = async (page) => {
    const {times, x} = await page.evaluate(() => {
      const {run} = window.whisker;
      return {times: [...run.t], x: [...run.column('x_m')]};
    });
    const trace = folder.trace('trap');
    assert.equal(times.length, trace.length);
    trace.forEach((row, i) => {
      assert.ok(Math.abs(times[i] - Number(row.t_s)) < 1e-9, `tick ${i} is at ${times[i]}`);
      assert.ok(Math.abs(x[i] - Number(row.x_m)) < 6e-7, `x at tick ${i}`);
    });
  };

  test('follows the run, and can look back', async () => {
    const {page, complaints} = await watch(startLong());
    await grown(page, 100);
    assert.equal(await page.textContent('#live-state'), 'live');
    assert.equal(await page.textContent('#verdict'), 'under way');
    const early = await tickOf(page);
    await grown(page, early + 100);
    await drawn(page);
    assert.ok((await tickOf(page)) > early, 'it does not follow');
    assert.ok((await pictureOf(page, 'world')).colours > 8);
    assert.equal(await page.getAttribute('#to-live', 'aria-pressed'), 'true');

    await page.keyboard.press('Home');
    await grown(page, (await ticksOf(page)) + 50);
    await drawn(page);
    assert.equal(await tickOf(page), 0, 'it does not stay where the reader looks');
    assert.equal(await page.getAttribute('#to-live', 'aria-pressed'), 'false');
    await page.keyboard.press('l');
    await grown(page, (await ticksOf(page)) + 10);
    assert.ok((await tickOf(page)) > early, 'it does not come back');
    await page.keyboard.press('Space');
    const paused = await tickOf(page);
    await grown(page, paused + 50);
    assert.equal(await tickOf(page), paused);
    await page.click('#to-live');
    await drawn(page);
    assert.ok((await tickOf(page)) > paused);
    assert.deepEqual(complaints, []);
  });

  test('sees the run to its end, and it is the one that nobody watches', async () => {
    const hil = start('hil', trap, '--view-stay', ...SLOW);
    const {page, complaints} = await watch(hil);
    await state(page, 'ended');
    await hil.says(/can still be watched/);
    await hil.stop();
    const {status, bus, ...result} = await hil.result();
    assert.equal(status, 0);
    assert.deepEqual(result, alone, 'watched, the run is another one');
    assert.ok(bus.sets > 0);
    await drawn(page);
    assert.match(await page.textContent('#facts'), new RegExp(alone.hash));
    assert.match(await page.textContent('#verdict'), /^reached the goal in/);
    assert.equal(await tickOf(page), alone.ticks - 1);
    assert.ok(await page.isHidden('#to-live'));
    assert.ok((await page.locator('#edge-rows tr').count()) > 0);
    await assertWhole(page);
    assert.deepEqual(complaints, []);
  });

  test('judges a robot by its true place, which the bus does not tell', async () => {
    const hil = start('hil', join(ROOT, 'tests/cli/scenarios/bad_wheels.toml'), '--view-stay');
    await hil.says(/the run is over/);
    const {page} = await watch(hil);
    await state(page, 'ended');
    await drawn(page);
    assert.match(await page.textContent('#verdict'), /^believes it is there; is \d\.\d\d m off, after/);
    const chip = await page.evaluate(() => {
      const style = getComputedStyle(document.documentElement);
      return ['goal', 'over'].find(
        (name) =>
          style.getPropertyValue(`--${name}`).trim() ===
          document.getElementById('state').style.getPropertyValue('--chip').trim(),
      );
    });
    assert.equal(chip, 'over');
  });

  test('knows of its own controller what a run knows', async () => {
    const hil = start('hil', trap, '--view-stay');
    await hil.says(/the run is over/);
    const {page} = await watch(hil);
    await state(page, 'ended');
    await drawn(page);
    for (const id of ['clear-known', 'clear-key', 'ranges-known'])
      assert.ok(await page.isVisible(`#${id}`), id);
    for (const id of ['clear-unknown', 'counters-unknown']) assert.ok(await page.isHidden(`#${id}`), id);
    assert.doesNotMatch(await page.innerText('#run'), /not known here|true distance/);
    const estimate = await page.evaluate(() => [...window.whisker.run.column('est_x_m')]);
    const trace = folder.trace('trap');
    assert.ok(estimate.every((x, tick) => Math.abs(x - Number(trace[tick].est_x_m)) < 6e-7));
    assert.ok((await page.evaluate(() => window.whisker.run.film.ticks.length)) > 100);
  });

  test('says what the bus does not tell', async () => {
    // A bus of two places, which ends with its input.
    const places = ['plant', 'controller'].map((name) => folder.at(name));
    const program =
      'import sys, slcan_bridge; slcan_bridge.Bridge(*sys.argv[1:]); print(flush=True); sys.stdin.read()';
    const bridge = spawn('python3', ['-B', '-c', program, ...places], {
      env: {...process.env, PYTHONPATH: join(ROOT, 'tests/cli')},
      stdio: ['pipe', 'pipe', 'inherit'],
    });
    await once(bridge.stdout, 'data');
    const [plantAt, controllerAt] = places.map((place) => `slcan:${place}`);
    const controller = new Running('controller', '--can', controllerAt, '--planner', 'skirt');
    all.push(controller);
    const plant = start('plant', trap, '--can', plantAt, '--view-stay');
    await plant.says(/the run is over/);
    bridge.stdin.end();
    const {page} = await watch(plant);
    await state(page, 'ended');
    await drawn(page);
    for (const id of ['clear-unknown', 'counters-unknown']) assert.ok(await page.isVisible(`#${id}`), id);
    for (const id of ['clear-known', 'clear-key', 'course-key']) assert.ok(await page.isHidden(`#${id}`), id);
    assert.match(await page.textContent('#table-says'), /not known here/);
    assert.match(await page.textContent('#plot-goal'), /true distance to the goal/);
    assert.equal(await page.locator('#counters > *').count(), 0);
    assert.match(await page.textContent('#facts'), /plannernot known here/);
    assert.equal(await page.textContent('#leave-rule'), '');
  });

  test('of a planner that nobody names no rule is told', async () => {
    whisker('hil', trap, '--planner', 'skirt', '--html', folder.at('hil.html'));
    const html = readFileSync(folder.at('hil.html'), 'utf8');
    writeFileSync(folder.at('nameless.html'), html.replace('"planner":"skirt"', '"planner":null'));
    const {page, complaints} = await openPage(folder.url('nameless.html'));
    assert.ok(await page.isHidden('#rule-of-progress'));
    assert.match(await page.textContent('#planner-of-progress'), /not known here/);
    assert.match(await page.textContent('#facts'), /plannernot known here/);
    assert.doesNotMatch(await page.textContent('#run'), /skirt|boundary planner/);
    assert.deepEqual(complaints, []);
  });

  test('who comes late is told everything, and several may come', async () => {
    const hil = start('hil', trap, '--view-stay');
    await hil.says(/the run is over/);
    for (let i = 0; i < 2; ++i) {
      const {page, complaints} = await watch(hil);
      await state(page, 'ended');
      await assertWhole(page);
      assert.deepEqual(complaints, []);
    }
    await hil.stop();
    assert.equal((await hil.result()).status, 0);
  });

  test('a line that breaks loses nothing and doubles nothing', async () => {
    const hil = startLong();
    const {port} = new URL(await hil.url());
    const open = new Set();
    const proxy = createServer((near) => {
      const far = connect(port, '127.0.0.1');
      // A server answers to its own name only.
      near.once('data', (bytes) => {
        far.write(bytes.toString('latin1').replace(/^host: .*$/im, `Host: 127.0.0.1:${port}`));
        near.pipe(far).pipe(near);
      });
      for (const end of [near, far]) end.on('error', () => {});
      open.add(near);
      near.on('close', () => far.destroy());
    });
    await once(proxy.listen(0, '127.0.0.1'), 'listening');
    try {
      const {page} = await openPage(`http://127.0.0.1:${proxy.address().port}/`, {server: 'http:'});
      await grown(page, 50);
      for (let i = 0; i < 2; ++i) {
        for (const end of open) end.destroy();
        await state(page, 'connecting');
        await grown(page, await ticksOf(page));
        await state(page, 'live');
      }
      await hil.stop();
      await state(page, 'ended');
      const times = await page.evaluate(() => [...window.whisker.run.t]);
      times.forEach((time, i) => assert.equal(time, i / 100));
    } finally {
      proxy.close();
    }
  });

  test('who finds no room is told so, and comes in when there is some', async () => {
    const hil = startLong();
    const {port} = new URL(await hil.url());
    const others = await Promise.all(
      Array.from({length: 24}, async () => {
        const line = connect(port, '127.0.0.1');
        line.on('error', () => {});
        line.write(`GET /events HTTP/1.1\r\nHost: 127.0.0.1:${port}\r\n\r\n`);
        await once(line, 'data');
        line.resume();
        return line;
      }),
    );
    try {
      const {page} = await watch(hil);
      await page.waitForFunction(() => document.getElementById('live-says').textContent !== '');
      assert.match(await page.textContent('#live-says'), /24 watch this run already/);
      assert.ok(await page.isVisible('#live-says'));
      for (const line of others) line.destroy();
      await grown(page, 10);
      await state(page, 'live');
    } finally {
      for (const line of others) line.destroy();
    }
  });

  test('sees an interruption', async () => {
    const hil = startLong();
    const {page, complaints} = await watch(hil);
    await grown(page, 100);
    const [status] = await hil.stop();
    assert.equal(status, 130);
    await state(page, 'ended');
    assert.match(await page.textContent('#live-says'), /interrupted/);
    assert.equal(await page.textContent('#verdict'), 'broken off');
    assert.deepEqual(complaints, []);
  });

  test('another run at the same place is shown instead', async () => {
    const first = startLong();
    const {page} = await watch(first);
    await grown(page, 100);
    const {port} = new URL(await first.url());
    await first.stop('SIGKILL');
    await state(page, 'connecting');
    assert.match(await page.textContent('#live-says'), /no answer/);
    const other = folder.at('other.toml');
    whisker('world', 'discs', '--seed', 3, '--out', other);
    const second = new Running('hil', other, '--view', port, '--view-stay', '--json');
    all.push(second);
    await page.waitForFunction(() => document.getElementById('title').textContent.includes('discs'));
    await state(page, 'ended');
  });

  test('says what a plant without a bus waits for', async () => {
    const plant = start('plant', trap, '--can', `slcan:${folder.at('nothing')}`);
    const {page, complaints} = await watch(plant);
    await page.waitForFunction(() => document.getElementById('live-says').textContent !== '');
    assert.match(await page.textContent('#live-says'), /^waits for /);
    assert.match(await page.textContent('#live-name'), /u-trap/);
    assert.ok(await page.isHidden('#run'));
    await plant.stop();
    await state(page, 'ended');
    assert.deepEqual(complaints, []);
  });

  test('a link to a time stays at it', async () => {
    const hil = start('hil', trap, '--view-stay', ...SLOW);
    await hil.says(/: drives/);
    const {page} = await watch(hil, {hash: '#t=0.5'});
    await grown(page, 500);
    assert.equal(await tickOf(page), 50);
    assert.equal(new URL(page.url()).hash, '#t=0.5');
  });

  everybodyCanRead(async (options) => {
    const watched = await watch(startLong(), options);
    await grown(watched.page, 500);
    return watched;
  });
});
