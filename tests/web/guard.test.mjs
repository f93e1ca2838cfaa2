// The page of a drive of the guard: what was asked, what was granted, and why.
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {drawn, pictureOf, seek, tickOf} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {U_TRAP, whisker, withoutOrigin} from './scenarios.mjs';
import * as sources from './sources.mjs';

// Half a unit of the trace's last decimal, and a little for the arithmetic.
const TOLERANCES = {
  t_s: 1e-9,
  x_m: 6e-7,
  y_m: 6e-7,
  heading_rad: 6e-7,
  v_left_mps: 6e-6,
  v_right_mps: 6e-6,
  asked_v_mps: 7e-6,
  asked_omega_radps: 7e-6,
  granted_v: 6e-5,
  granted_omega: 6e-5,
};

test('words: what is asked for, and how much of it is granted', async () => {
  const {velocityWords, shareWords} = await sources.guardWords();
  assert.equal(velocityWords({forward: 0.3, turning: 0.5}), '0.30 m/s ahead and 29°/s left');
  assert.equal(velocityWords({forward: -0.3, turning: -0.5}), '0.30 m/s back and 29°/s right');
  assert.equal(velocityWords({forward: 0, turning: 0}), 'nothing');
  assert.equal(
    shareWords({forward: 0.3, turning: 0.5}, {forward: 0.4, turning: 1}),
    '40 % of the speed, 100 % of the turning',
  );
  assert.equal(shareWords({forward: 0, turning: -1}, {forward: 1, turning: 0.5}), '50 % of the turning');
  assert.equal(shareWords({forward: 0, turning: 0}, {forward: 1, turning: 1}), '');
});

test('grants: shares of what was asked, on scales that end a little beyond what the wheels can do', async () => {
  const {Grants} = await sources.grants();
  const columns = {
    asked_v_mps: [0, 2000, -0.2],
    asked_omega_radps: [0, 1, -2],
    granted_v: [1, 0.5, 0.25],
    granted_omega: [1, 1, 0.5],
    v_left_mps: [0, 0.3, 0.1],
    v_right_mps: [0, 0.3, -0.1],
    reason: [1, 0, 0],
  };
  const run = {
    info: {guard: {guarded: true, reasons: ['clear', 'obstacle']}, robot: {max_speed: 0.3, track: 0.2}},
    column: (name) => Float64Array.from(columns[name]),
  };
  const grants = new Grants(run);
  assert.deepEqual([...grants.granted.forward], [0, 1000, -0.05]);
  assert.deepEqual([...grants.granted.turning], [0, 1, -1]);
  assert.ok(Math.abs(grants.driven.turning[2] + 1) < 1e-9);
  assert.ok(Math.abs(grants.most('forward') - 0.39) < 1e-9);
  assert.equal(grants.most('turning'), 2);
  assert.deepEqual([grants.reason(0), grants.colour(0)], ['obstacle', 'danger']);
  run.info.guard.guarded = false;
  assert.equal(grants.reason(0), 'no_guard');
});

test('every reason of the core has its words', async () => {
  const {REASONS} = await sources.guardWords();
  const told = JSON.parse(whisker('guard', U_TRAP, '--time', 0.1, '--operator', 'joystick', '--json'));
  assert.deepEqual(Object.keys(REASONS), Object.keys(told.ticks_by_reason));
});

describe('the page of a drive of the guard', () => {
  const {folder, openPage} = inBrowser(() => {
    whisker('world', 'discs', '--seed', 1, '--out', folder.at('world.toml'));
    drive('sloppy', '--operator', 'sloppy');
    drive('hostile', '--operator', 'hostile');
    drive('bare', '--operator', 'blind', '--bare');
  });
  const results = {};
  const drive = (name, ...options) => {
    const files = ['--html', folder.at(`${name}.html`), '--trace', folder.at(`${name}.csv`)];
    results[name] = JSON.parse(whisker('guard', folder.at('world.toml'), '--json', ...files, ...options));
  };
  const open = (name, hash = '', options = {}) => openPage(folder.url(`${name}.html`, hash), options);

  for (const name of ['sloppy', 'hostile', 'bare']) {
    test(`${name}: what the page decodes is the trace`, async () => {
      const {page, complaints} = await open(name);
      const trace = folder.trace(name);
      const {info, ticks, columns} = await page.evaluate((names) => {
        const {run} = window.whisker;
        const {guard} = run.info;
        return {
          info: run.info,
          ticks: run.ticks,
          columns: {
            ...Object.fromEntries(names.map((column) => [column, [...run.column(column)]])),
            why: [...run.column('reason')].map((reason) => guard.reasons[reason]),
          },
        };
      }, Object.keys(TOLERANCES));
      assert.equal(ticks, trace.length);
      trace.forEach((row, tick) => {
        if (row.state === 'guarded') assert.equal(columns.why[tick], row.why);
        // The page shows what counts: nothing, once a command is too old.
        if (row.why === 'command_timeout') {
          assert.equal(columns.asked_v_mps[tick], 0);
          return;
        }
        for (const [column, tolerance] of Object.entries(TOLERANCES)) {
          if (row[column] === '') assert.equal(columns[column][tick], 1, 'all is granted without the guard');
          else {
            const off = Math.abs(columns[column][tick] - Number(row[column]));
            assert.ok(off <= tolerance, `${column} at tick ${tick} is off by ${off}`);
          }
        }
      });
      assert.deepEqual(info.result, withoutOrigin(results[name]));
      assert.equal(info.guard.guarded, name !== 'bare');
      assert.deepEqual(complaints, []);
    });
  }

  test('opens whole, with the parts of a drive only', async () => {
    const {page, complaints} = await open('sloppy');
    assert.match(await page.textContent('#verdict'), /^arrived at the goal after \d+\.\d s$/);
    assert.equal(await page.textContent('#planner-name'), 'sloppy operator, guard on');
    for (const id of ['world', 'closeup', 'lanes']) {
      assert.ok((await pictureOf(page, id)).colours > 8, `${id} is empty`);
    }
    assert.equal(await page.locator('.uplot').count(), 5);
    assert.deepEqual(await page.locator('.lane-name').allTextContents(), ['why', 'speed', 'turning']);
    for (const id of ['h-turns', 'h-stuck', 'clear-unknown']) assert.ok(await page.isHidden(`#${id}`), id);
    for (const id of ['h-asked', 'h-reasons', 'h-senses', 'clear-known', 'granted-key']) {
      assert.ok(await page.isVisible(`#${id}`), id);
    }
    assert.deepEqual(complaints, []);
  });

  test('the page of a mission has none of its parts', async () => {
    folder.run('mission', U_TRAP);
    const {page} = await open('mission');
    const parts = page.locator('#run [data-of]:not([data-colour], #course-key)');
    for (const part of await parts.all()) {
      const kind = await part.getAttribute('data-of');
      assert.equal(await part.evaluate((node) => node.hidden), kind !== 'mission');
    }
    assert.ok((await parts.count()) > 5);
  });

  test('counts contacts, clearance, and the time of each reason', async () => {
    const {page} = await open('sloppy');
    const result = results.sloppy;
    const counts = await page.locator('#guard-counts dd').allTextContents();
    assert.equal(counts[0], '0');
    assert.equal(counts[1], `${result.min_clearance_m.toFixed(3)} m`);
    assert.equal(counts[2], `${(100 * result.granted).toFixed(0)} %`);
    assert.match(counts[3], new RegExp(`^${result.stops} \\(`));
    const came = Object.entries(result.ticks_by_reason).filter(([, ticks]) => ticks > 0);
    const rows = await page.evaluate(() =>
      [...document.querySelectorAll('#reason-rows tr')].map((row) => [
        row.querySelector('button').textContent,
        row.cells[1].textContent,
      ]),
    );
    assert.deepEqual(
      rows.map(([reason]) => reason),
      came.map(([reason]) => reason.replaceAll('_', ' ')),
    );
    // A half may be rounded either way.
    came.forEach(([, ticks], i) => assert.ok(Math.abs(Number.parseFloat(rows[i][1]) - ticks / 100) < 0.051));
    const never = await page.textContent('#reasons-never');
    for (const [reason, ticks] of Object.entries(result.ticks_by_reason)) {
      assert.equal(never.includes(reason.replaceAll('_', ' ')), ticks === 0, reason);
    }
  });

  test('says what was asked and granted, and why, at every tick', async () => {
    const {page} = await open('sloppy');
    const trace = folder.trace('sloppy');
    for (const reason of ['clear', 'nodding', 'obstacle', 'assisted']) {
      // The trace has the share rounded: none that lies between two whole per cents.
      const tick = trace.findIndex(
        ({why, asked_v_mps: v, granted_v: share}) =>
          why === reason && Number(v) > 0.05 && Math.abs(((100 * share) % 1) - 0.5) > 0.1,
      );
      await seek(page, tick);
      assert.equal(await page.textContent('#state'), reason);
      const {asked_v_mps: v, granted_v: share} = trace[tick];
      const words = await page.textContent('#sentence');
      assert.ok(words.includes(`Asked: ${Number(v).toFixed(2)} m/s ahead`), words);
      assert.match(words, new RegExp(`${Math.round(100 * share)} % of the speed`));
      assert.equal(await page.textContent('#reason-rows .current button'), reason);
    }
  });

  test('a reason leads to its times, in turn, and the keys go from reason to reason', async () => {
    const {page} = await open('sloppy');
    const whys = folder.trace('sloppy').map(({why}) => why);
    const begins = whys.flatMap((why, tick) => (why === 'assisted' && whys[tick - 1] !== why ? [tick] : []));
    const button = page.locator('#reason-rows button', {hasText: 'assisted'});
    for (const tick of [...begins, begins[0]].slice(0, 4)) {
      await button.click();
      assert.equal(await tickOf(page), tick);
    }
    await page.keyboard.press('Home');
    await page.keyboard.press(']');
    assert.equal(
      await tickOf(page),
      whys.findIndex((why) => why !== whys[0]),
    );
  });

  test('draws what is asked and what is granted at the body', async () => {
    const {page} = await open('sloppy');
    const tick = folder
      .trace('sloppy')
      .findIndex(
        ({why, granted_v: share, asked_v_mps: v}) =>
          why === 'obstacle' && Number(share) < 0.5 && Number(v) > 0.15,
      );
    await seek(page, tick);
    const before = await pictureOf(page, 'closeup');
    await page.evaluate((at) => {
      const {run, player} = window.whisker;
      run.column('asked_v_mps')[at] *= -1;
      player.request();
    }, tick);
    await drawn(page);
    assert.notEqual((await pictureOf(page, 'closeup')).sum, before.sum, 'the asked way is not drawn');
  });

  test('the clear ground is around the robot, wherever it was put down', async () => {
    const {page} = await open('sloppy', '#t=30');
    const far = await page.evaluate(() => {
      const {run, player} = window.whisker;
      const {cell} = run.info.robot;
      const at = (name) => run.column(name)[player.tick];
      const frame = run.film.seek(player.tick);
      const body = ['grid_x_m', 'grid_y_m'].map((name) => Math.floor(run.column(name)[frame] / cell + 1e-6));
      let [count, most] = [0, 0];
      run.film.forEachClear(...body, (x, y) => {
        ++count;
        most = Math.max(
          most,
          Math.hypot((x + 0.5) * cell - at('grid_x_m'), (y + 0.5) * cell - at('grid_y_m')),
        );
      });
      return {count, most, off: Math.hypot(at('est_x_m') - at('x_m'), at('est_y_m') - at('y_m'))};
    });
    assert.ok(far.count > 50, `${far.count} clear cells`);
    assert.ok(far.most < 1.5, `a clear cell is ${far.most} m away`);
    assert.ok(far.off < 0.05, `the estimate is ${far.off} m off`);
  });

  test('without the guard, it says so and counts the contact', async () => {
    const {page, complaints} = await open('bare', '#t=99');
    assert.equal(await page.textContent('#state'), 'no guard');
    assert.equal(await page.textContent('#guard-counts dd'), '1');
    for (const id of ['panel-reasons', 'share-plot', 'granted-key', 'clear-unknown']) {
      assert.ok(await page.isHidden(`#${id}`), id);
    }
    assert.match(await page.textContent('#verdict'), /^touched an obstacle/);
    assert.deepEqual(complaints, []);
  });

  test('a command beyond all limits is drawn, too', async () => {
    const {page, complaints} = await open('hostile');
    const most = await page.evaluate(() => Math.max(...window.whisker.run.column('asked_v_mps')));
    assert.ok(most > 100);
    assert.ok((await pictureOf(page, 'lanes')).colours > 8);
    assert.deepEqual(complaints, []);
  });

  everybodyCanRead((options) => open('sloppy', '#t=32', options));
});
