// The playground in a browser.
import assert from 'node:assert/strict';
import {readFileSync, statSync} from 'node:fs';
import {join} from 'node:path';
import {describe, test} from 'node:test';
import {drawn, pictureOf} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {ROOT, whisker} from './scenarios.mjs';

const PAGE = process.env.PLAYGROUND ?? join(ROOT, 'out/playground/index.html');

describe('the playground', () => {
  const {folder, openPage} = inBrowser();
  // It plays by itself unless the reader wants less motion.
  const open = (hash = '', options = {}) =>
    openPage(`file://${PAGE}${hash}`, {reducedMotion: 'reduce', ...options});
  const play = (page, look) => page.evaluate(`(({play, stage}) => (${look}))(window.whisker)`);
  const toTheEnd = async (page) => {
    await page.click('#finish');
    await page.waitForFunction(() => window.whisker.play.over);
    await drawn(page);
  };
  /** Where a place of the world is on the screen, in the view of a robot. */
  const place = (page, [x, y], card = 0) =>
    page.evaluate(
      ([at, which]) => {
        const canvas = document.querySelectorAll('.card canvas')[which];
        const box = canvas.getBoundingClientRect();
        const [px, py] = window.whisker.play.camera.toScreen(at[0], at[1], box.width, box.height);
        return [box.left + px, box.top + py];
      },
      [[x, y], card],
    );
  const drag = async (page, from, to, card = 0) => {
    const [x0, y0] = await place(page, from, card);
    const [x1, y1] = await place(page, to, card);
    await page.mouse.move(x0, y0);
    await page.mouse.down();
    await page.mouse.move((x0 + x1) / 2, (y0 + y1) / 2, {steps: 3});
    await page.mouse.move(x1, y1, {steps: 3});
    await page.mouse.up();
    await drawn(page);
  };
  const near = (a, b, what) =>
    assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1]) < 0.03, `${what}: ${a}, not ${b}`);
  const download = async (page, button) => {
    const [file] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
    const path = folder.at(file.suggestedFilename());
    await file.saveAs(path);
    return path;
  };

  test('opens from a file, whole and without a complaint', async () => {
    const {page, complaints} = await open();
    assert.equal(await page.locator('.card:visible').count(), 2);
    for (const id of ['closeup', 'heat-turn', 'heat-step']) {
      assert.ok((await pictureOf(page, id)).colours > 8, `${id} is empty`);
    }
    assert.equal(await page.locator('.rule').count(), 25);
    assert.match(await page.textContent('#rules-good'), /Symmetric and safe/);
    assert.equal(await play(page, 'play.time'), 0);
    assert.deepEqual(complaints, []);
  });

  test('is one file of less than 260 kB', () => {
    assert.ok(statSync(PAGE).size < 260_000);
  });

  test('drives by itself, unless less motion is wanted', async () => {
    const {page} = await open('', {reducedMotion: 'no-preference'});
    await page.waitForFunction(() => window.whisker.play.time > 0.2);
  });

  test('plays, pauses, and begins again', async () => {
    const {page} = await open('#world=discs&seed=3&planner=skirt');
    await page.click('#play');
    await page.waitForFunction(() => window.whisker.play.time > 0.3);
    await page.keyboard.press('Control');
    await page.click('#play');
    const time = await play(page, 'play.time');
    await drawn(page);
    assert.equal(await play(page, 'play.time'), time);
    await page.locator('body').press('r');
    assert.equal(await play(page, 'play.time'), 0);
  });

  test('shows the hash, and that it equals the native one', async () => {
    const {page, complaints} = await open('#world=u-trap&seed=7&planner=skirt');
    await toTheEnd(page);
    assert.match(await page.textContent('#card-0 .verdict'), /^reached the goal in/);
    assert.match(await page.textContent('#hashes'), /equals the native run/);
    const world = folder.at('u.toml');
    whisker('world', 'u-trap', '--seed', 7, '--out', world);
    const {hash} = JSON.parse(whisker('run', world, '--planner', 'skirt', '--json'));
    assert.match(await page.textContent('#hashes'), new RegExp(hash));
    assert.deepEqual(complaints, []);
  });

  test('a robot that only believes to be there is not shown as one that is', async () => {
    const {page, complaints} = await open(
      '#world=discs&seed=11&planner=skirt&noise=0.01_0.02_0.01_0.005_0.3',
    );
    await toTheEnd(page);
    const {outcome, distance, believed} = await play(page, 'play.runs[0].result');
    assert.equal(outcome, 'off_goal');
    assert.ok(believed <= 0.1 && distance > 0.1);
    const verdict = page.locator('#card-0 .verdict');
    assert.ok(
      (await verdict.textContent()).startsWith(
        `believes it is there; is ${distance.toFixed(2)} m off, after`,
      ),
    );
    const colour = await verdict.evaluate((node) => getComputedStyle(node).color);
    const contact = await verdict.evaluate((node) => {
      node.dataset.outcome = 'contact';
      return getComputedStyle(node).color;
    });
    assert.equal(colour, contact);
    assert.match(await page.textContent('#spoken'), /believes it is there; is/);
    const world = folder.at('off.toml');
    whisker('world', 'discs', '--seed', 11, '--noise', '--wheel-scale-sigma', 0.005, '--out', world);
    const native = JSON.parse(whisker('run', world, '--planner', 'skirt', '--json'));
    assert.equal(native.outcome, 'off_goal');
    assert.ok(Math.abs(native.final_distance_m - distance) < 1e-6);
    assert.ok(Math.abs(native.believed_distance_m - believed) < 1e-6);
    assert.deepEqual(complaints, []);
  });

  test('the scenario that it saves drives natively to the same hash', async () => {
    const {page} = await open('#world=maze&seed=11&planner=skirt&noise=0.01_0.02_0.01_0.0001_0.3');
    await page.selectOption('#things', {index: 1});
    await page.locator('#card-0 canvas').press('ArrowLeft');
    assert.equal(await play(page, 'play.touched'), false);
    await toTheEnd(page);
    const file = await download(page, '#save-scenario');
    const {hash} = JSON.parse(whisker('run', file, '--planner', 'skirt', '--json'));
    assert.match(await page.textContent('#hashes'), new RegExp(hash));
  });

  test('an obstacle is dragged, while it drives, in both worlds', async () => {
    const {page, complaints} = await open('#world=discs&seed=3&planner=both');
    const before = await play(page, 'play.situation.world.discs[0]');
    await page.click('#play');
    await page.waitForFunction(() => window.whisker.play.time > 0.2);
    const to = [before[0] + 0.5, before[1] - 0.4];
    await drag(page, before, to, 1);
    near(await play(page, 'play.situation.world.discs[0]'), to, 'the disc');
    assert.deepEqual(await play(page, 'play.runs.map((run) => run.info.world.discs[0])'), [
      await play(page, 'play.situation.world.discs[0]'),
      await play(page, 'play.situation.world.discs[0]'),
    ]);
    assert.equal(await play(page, 'play.touched'), true);
    assert.match(await page.textContent('#hashes'), /changed during the run/);
    await page.click('#original');
    assert.deepEqual(await play(page, 'play.situation.world.discs[0]'), before);
    assert.deepEqual(complaints, []);
  });

  test('the goal is dragged and reached where it is then', async () => {
    const {page} = await open('#world=u-trap&seed=1&planner=skirt');
    const {start, goal} = await play(page, 'play.situation.world');
    await page.evaluate(() => window.whisker.play.pass(1));
    const to = [goal[0] + 0.3 * (start[0] - goal[0]), goal[1] + 0.3 * (start[1] - goal[1]) + 0.2];
    await drag(page, goal, to);
    near(await play(page, 'play.situation.world.goal'), to, 'the goal');
    await toTheEnd(page);
    assert.equal(await play(page, 'play.runs[0].result.outcome'), 'reached');
    assert.ok((await play(page, 'play.runs[0].distance')) < 0.11);
  });

  test('nothing is put onto a robot', async () => {
    const {page} = await open('#world=discs&seed=3&planner=skirt');
    const [x, y] = await play(page, 'play.situation.world.discs[0]');
    const {start} = await play(page, 'play.situation.world');
    await drag(page, [x, y], start);
    const [nx, ny, radius] = await play(page, 'play.situation.world.discs[0]');
    assert.ok(Math.hypot(nx - start[0], ny - start[1]) > radius + 0.09);
  });

  test('things are added, sized and removed by keyboard alone', async () => {
    const {page} = await open('#world=u-trap&seed=7&planner=skirt');
    for (const kind of ['disc', 'bar', 'wall', 'mover']) {
      await page.locator(`#add-${kind}`).press('Enter');
      assert.equal(await page.textContent('#told'), '', kind);
    }
    const count =
      'Object.fromEntries(["discs", "polygons", "walls", "movers"].map((k) => [k, play.situation.world[k].length]))';
    assert.deepEqual(await play(page, count), {discs: 1, polygons: 2, walls: 1, movers: 1});
    await page.selectOption('#things', {index: 3});
    const canvas = page.locator('#card-0 canvas');
    const [x, y, radius] = await play(page, 'play.situation.world.discs[0]');
    await canvas.press('Shift+ArrowUp');
    await canvas.press('-');
    const [nx, ny, smaller] = await play(page, 'play.situation.world.discs[0]');
    near([nx, ny], [x, y + 0.25], 'the disc');
    assert.ok(smaller < radius);
    await canvas.press('Delete');
    assert.equal(await play(page, 'play.situation.world.discs.length'), 0);
    await toTheEnd(page);
  });

  test('an edit of a rule warns, shows in the table and changes the drive', async () => {
    const {page} = await open('#world=discs&seed=3&planner=thesis');
    await toTheEnd(page);
    const hash = await play(page, 'play.runs[0].result.hash');
    const picture = (await pictureOf(page, 'heat-turn')).sum;
    // Near ahead, the left much nearer: hard right becomes hard left.
    const square = page.locator('[data-rule="14"]');
    assert.match(await square.getAttribute('aria-label'), /left much nearer: turn right hard/);
    await square.click({modifiers: ['Shift']});
    assert.match(await square.getAttribute('aria-label'), /turn left hard, changed, at fault/);
    assert.match(await page.textContent('#rule-warnings'), /Not symmetric/);
    assert.match(
      await page.textContent('#rule-warnings'),
      /Unsafe: a rule turns towards the side that is nearer/,
    );
    await drawn(page);
    assert.notEqual((await pictureOf(page, 'heat-turn')).sum, picture);
    assert.match(await page.textContent('#hashes'), /changed during the run/);
    await page.click('#again');
    await toTheEnd(page);
    assert.notEqual(await play(page, 'play.runs[0].result.hash'), hash);
    const table = readFileSync(await download(page, '#save-table'), 'utf8');
    assert.notEqual(table, readFileSync(join(ROOT, 'firmware/fuzzy/response_table.hpp'), 'utf8'));

    await page.click('#rules-mirror');
    assert.equal(await page.textContent('#rule-warnings'), '');
    await page.click('#edit-step');
    await page.locator('[data-rule="22"]').click();
    assert.match(await page.textContent('#rule-warnings'), /steps longer|Not symmetric|^$/);
    await page.click('#rules-reset');
    await page.click('#again');
    await toTheEnd(page);
    assert.equal(await play(page, 'play.runs[0].result.hash'), hash);
    assert.match(await page.textContent('#hashes'), /equals the native run/);
  });

  test('the planner is switched, and the address with it', async () => {
    const {page} = await open('#world=spiral&seed=2&planner=skirt');
    await page.click('#who-thesis');
    await drawn(page);
    assert.equal(await page.textContent('#card-0 h2'), 'thesis planner');
    assert.deepEqual(await page.locator('#who button').allTextContents(), [
      'Boundary planner',
      'Thesis planner',
      'Map planner',
      'Boundary and thesis',
      'Boundary and map',
      'Drive it yourself',
      'A Pico',
    ]);
    await page.waitForFunction(() => location.hash.includes('planner=thesis'));
    await page.click('#who-both');
    assert.equal(await page.locator('.card:visible').count(), 2);
    await page.selectOption('#kind', 'rooms');
    await page.waitForFunction(() => location.hash.includes('world=rooms'));
    await page.fill('#seed', '5');
    await page.locator('#seed').press('Enter');
    assert.equal(await play(page, 'play.state.seed'), 5);
    await page.fill('#seed', '-1');
    await page.locator('#seed').press('Enter');
    assert.match(await page.textContent('#told'), /no such world/);
    assert.equal(await play(page, 'play.state.seed'), 5);
  });

  test('the map planner drives natively to the same hash, and shows its map', async () => {
    const {page, complaints} = await open('#world=rooms&seed=3&planner=map');
    assert.equal(await page.textContent('#card-0 h2'), 'map planner');
    const canvas = () =>
      page.evaluate(() => {
        const picture = document.querySelector('.card canvas');
        const {data} = picture.getContext('2d').getImageData(0, 0, picture.width, picture.height);
        return new Set(new Uint32Array(data.buffer)).size;
      });
    const before = await canvas();
    await page.evaluate(() => {
      const {play} = window.whisker;
      play.runs[0].advance(1500);
      play.runs[0].refresh();
      play.select(null);
    });
    await drawn(page);
    assert.ok((await canvas()) > before, 'nothing of a map is drawn');
    assert.equal(await page.locator('[data-state]:visible').count(), 5);
    const known = await play(
      page,
      '[...Array(64 * 56).keys()].filter((i) => { const {map} = play.runs[0]; return map.state(map.corner[0] + (i % 64), map.corner[1] + Math.floor(i / 64)) > 0; }).length',
    );
    assert.ok(known > 100, `${known} cells are known`);
    await toTheEnd(page);
    assert.match(await page.textContent('#hashes'), /equals the native run/);
    await page.click('#who-skirt-map');
    assert.equal(await page.locator('.card:visible').count(), 2);
    await page.waitForFunction(() => location.hash.includes('planner=skirt-map'));
    await page.click('#who-both');
    await drawn(page);
    assert.equal(await page.locator('[data-state]:visible').count(), 0);
    assert.deepEqual(complaints, []);
  });

  test('the address alone brings all of it back', async () => {
    const first = (await open('#world=discs&seed=8&planner=skirt')).page;
    await first.click('#add-disc');
    await first.locator('#card-0 canvas').press('ArrowUp');
    await first.locator('#noise-0').fill('12');
    await first.locator('[data-rule="03"]').click();
    await first.waitForFunction(
      () => /own=.*/.test(location.hash) && /noise=0.012/.test(location.hash) && /rules=/.test(location.hash),
    );
    await first.click('#again');
    await toTheEnd(first);
    const url = first.url();
    assert.ok(url.length < 4000, `${url.length} characters`);
    const {page: second, complaints} = await open(url.slice(url.indexOf('#')));
    assert.equal(await second.inputValue('#noise-0'), '12');
    assert.equal(await second.locator('.rule.own').count(), 1);
    await toTheEnd(second);
    assert.equal(
      await play(second, 'play.runs[0].result.hash'),
      await play(first, 'play.runs[0].result.hash'),
    );
    assert.deepEqual(complaints, []);
  });

  test('things as small as they get are good for a file', async () => {
    const {page} = await open('#world=u-trap&seed=7&planner=skirt');
    const canvas = page.locator('#card-0 canvas');
    for (const kind of ['disc', 'bar', 'wall']) {
      await page.locator(`#add-${kind}`).press('Enter');
      for (let i = 0; i < 60; ++i) await canvas.press('-');
    }
    whisker('run', await download(page, '#save-scenario'));
  });

  for (const width of [390, 412, 800, 1440]) {
    test(`all of the world is in view at first, also at ${width} px`, async () => {
      const {page} = await open('', {viewport: {width, height: 860}});
      const off = await page.evaluate(() => {
        const {camera, situation} = window.whisker.play;
        const shown = [...document.querySelectorAll('.card canvas')].filter(
          (canvas) => canvas.clientWidth > 0,
        );
        return shown.flatMap(({clientWidth: width, clientHeight: height}) =>
          [situation.world.start, situation.world.goal, ...situation.world.polygons.flat()].filter(
            ([x, y]) => {
              const [px, py] = camera.toScreen(x, y, width, height);
              return px < 0 || py < 0 || px > width || py > height;
            },
          ),
        );
      });
      assert.deepEqual(off, []);
    });
  }

  for (const [width, height] of [
    [844, 390],
    [800, 600],
    [1280, 520],
    [1180, 580],
    [390, 844],
  ]) {
    test(`what plays the run is in sight at ${width}x${height}`, async () => {
      for (const hash of ['', '#world=rooms&seed=3&planner=you']) {
        const {page} = await open(hash, {viewport: {width, height}});
        const {y, height: tall} = await page.locator('#play').boundingBox();
        assert.ok(y >= 0 && y + tall <= height, `#play is at ${y}`);
        assert.ok((await page.locator('.card canvas').first().boundingBox()).height > 150);
      }
    });
  }

  test('its keys list what has occurred', async () => {
    const {page} = await open('#world=u-trap&seed=7&planner=skirt');
    const keys = async () =>
      (await page.locator('.key-list li:visible').allTextContents()).map((key) => key.trim());
    assert.deepEqual(await keys(), ['drives freely', 'ground proved clear']);
    await toTheEnd(page);
    const after = await keys();
    assert.ok(after.includes('follows a boundary'), `${after}`);
    assert.ok(await page.isVisible('#course-key'));
    await page.click('#who-thesis');
    await toTheEnd(page);
    assert.ok((await keys()).includes('deflected by the table'));
    assert.ok(await page.isVisible('#course-key'));
    await page.click('#who-you');
    await drawn(page);
    await page.keyboard.down('ArrowUp');
    await page.evaluate(() => window.whisker.play.pass(0.3));
    await page.keyboard.up('ArrowUp');
    await drawn(page);
    const came = await page.evaluate(() => {
      const {play, core} = window.whisker;
      return play.runs[0].stretches.map(({kind}) => core.words.reasons[kind].replaceAll('_', ' '));
    });
    const [asked, ...reasons] = await keys();
    assert.equal(asked, 'asked');
    assert.deepEqual(new Set(reasons), new Set([...came, 'ground proved clear']));
  });

  test('noise begins the drive anew, and the same noise gives the same drive', async () => {
    const {page} = await open('#world=u-trap&seed=3&planner=skirt');
    await toTheEnd(page);
    const quiet = await play(page, 'play.runs[0].result.hash');
    await page.click('#noise-reference');
    assert.equal(await play(page, 'play.time'), 0);
    await toTheEnd(page);
    assert.notEqual(await play(page, 'play.runs[0].result.hash'), quiet);
    await page.click('#noise-none');
    await toTheEnd(page);
    assert.equal(await play(page, 'play.runs[0].result.hash'), quiet);
  });

  describe('driven by the user', () => {
    const YOU = '#world=discs&seed=3&planner=you';
    const contacts = (page) => page.locator('.drive-counts dd').allTextContents();
    /** Simulated seconds with a command, without waiting for them. */
    const drive = (page, seconds, ahead, left) =>
      page
        .evaluate(
          ([time, x, y]) => {
            const {play, driver} = window.whisker;
            driver.ask(x, y);
            for (let i = 0; i < 10 * time; ++i) play.runs[0].advance(10);
            driver.ask(0, 0);
            play.runs[0].refresh();
            play.select(null);
          },
          [seconds, ahead, left],
        )
        .then(() => drawn(page));

    test('shows the parts of a driver, and those of the planners again', async () => {
      const {page, complaints} = await open(YOU);
      assert.equal(await page.textContent('#card-0 h2'), 'you drive');
      for (const id of ['stick', 'switch-guarded', 'command', 'save-drive']) {
        assert.ok(await page.isVisible(`#${id}`), id);
      }
      for (const id of ['h-stuck', 'finish']) assert.ok(await page.isHidden(`#${id}`), id);
      await page.click('#who-map');
      await drawn(page);
      for (const id of ['stick', 'command', 'save-drive']) assert.ok(await page.isHidden(`#${id}`), id);
      for (const id of ['h-stuck', 'finish']) assert.ok(await page.isVisible(`#${id}`), id);
      assert.deepEqual(complaints, []);
    });

    test('arrow keys and W A S D start it and steer it', async () => {
      const {page} = await open(YOU);
      for (const [key, forward, turning] of [
        ['ArrowUp', 0.3, 0],
        ['KeyS', -0.3, 0],
        ['ArrowLeft', 0, 1.5],
        ['KeyD', 0, -1.5],
      ]) {
        await page.keyboard.down(key);
        assert.deepEqual(await page.evaluate('window.whisker.driver.asked'), {forward, turning}, key);
        await page.keyboard.up(key);
      }
      assert.equal(await play(page, 'play.playing'), true);
      await page.keyboard.down('w');
      await page.waitForFunction(() => window.whisker.play.runs[0].grant.asked.forward === 0.3);
      await page.keyboard.up('w');
      await page.waitForFunction(() => window.whisker.play.runs[0].grant.asked.forward === 0);
      // The theme has another key for everybody else.
      await page.keyboard.press('d');
      assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), undefined);
      await page.keyboard.down('w');
      await page.evaluate(() => dispatchEvent(new Event('blur')));
      assert.equal(await page.evaluate('window.whisker.driver.asked.forward'), 0);
      await page.keyboard.up('w');
      await page.focus('#card-0 canvas');
      await page.keyboard.down('ArrowUp');
      assert.equal(await page.evaluate('window.whisker.driver.asked.forward'), 0.3);
      await page.keyboard.up('ArrowUp');
      await page.focus('#seed');
      await page.keyboard.down('ArrowUp');
      assert.equal(await page.evaluate('window.whisker.driver.asked.forward'), 0);
      await page.keyboard.up('ArrowUp');
    });

    test('the joystick asks for no more than the wheels can do, and for nothing once it is let go', async () => {
      const {page} = await open(YOU);
      const box = await page.locator('#stick').boundingBox();
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      const asked = () => page.evaluate('window.whisker.driver.asked');
      const nothing = async () => Object.values(await asked()).every((part) => part === 0);
      await page.mouse.move(x, y);
      await page.mouse.down();
      assert.equal(await nothing(), true);
      await page.mouse.move(x - box.width, y - box.height, {steps: 3});
      const {forward, turning} = await asked();
      const {max_speed, track} = await page.evaluate('window.whisker.core.robot');
      assert.ok(turning > 1 && forward > 0.1);
      assert.ok(forward + (turning * track) / 2 <= max_speed + 1e-9);
      await page.mouse.up();
      assert.equal(await nothing(), true);
    });

    test('nothing is touched with the guard, everything without', async () => {
      const {page} = await open(YOU);
      for (const [ahead, left] of [
        [1, 0],
        [1, 0.5],
        [1, -0.5],
        [-1, 0.2],
        [1, 0],
      ]) {
        await drive(page, 12, ahead, left);
      }
      assert.deepEqual(await contacts(page), ['0', '0']);
      assert.ok((await play(page, 'play.runs[0].result.way')) > 1);
      assert.ok((await play(page, 'play.runs[0].result.clearance')) > 0);
      await page.click('#again');
      await page.click('#switch-guarded');
      await drawn(page);
      assert.equal(await page.getAttribute('#switch-guarded', 'aria-pressed'), 'false');
      for (let i = 0; i < 4; ++i) await drive(page, 12, 1, 0.02 * i);
      assert.deepEqual(await contacts(page), ['0', '1']);
      assert.match(await page.textContent('#card-0 .verdict'), /^touched an obstacle/);
      assert.match(await page.textContent('#command'), /--bare/);
    });

    test('says what is asked, granted and why', async () => {
      const {page} = await open(YOU);
      await drive(page, 0.2, 1, 0);
      assert.equal(await play(page, 'play.runs[0].grant.reason'), 'nodding');
      assert.match(
        await page.textContent('#card-0 .what-now'),
        /nodding Asked: 0.30 m\/s ahead. Granted: 0 % of the speed/,
      );
      assert.equal(await page.textContent('#asked-forward'), '0.30');
      assert.equal(await page.textContent('#granted-forward'), '0.00');
    });

    test('a switch takes effect once the robot stands, and without a jump', async () => {
      const {page} = await open(YOU);
      await drive(page, 6, 1, 0);
      const at = () => play(page, "['x_m', 'y_m'].map((name) => play.runs[0].column(name)[0])");
      await drive(page, 1, 0, 0);
      const before = await at();
      await page.click('#switch-nods');
      await drive(page, 1, 0, 0);
      near(await at(), before, 'the robot');
      assert.equal(await play(page, 'play.touched'), true);
      assert.deepEqual(await page.evaluate('window.whisker.driver.parameters()'), ['guard_nods = false']);
      for (let i = 0; i < 4; ++i) {
        await drive(page, 3, 1, 0.4);
        assert.notEqual(await play(page, 'play.runs[0].grant.reason'), 'nodding');
      }
      const off = await play(page, "Math.hypot(...['x_m', 'y_m'].map((n) => play.runs[0].column(`est_${n}`)[0] - play.runs[0].column(n)[0]))"); // prettier-ignore
      assert.ok(off < 0.02, `the estimate is ${off} m off`);
    });

    test('the drive that it saves is natively the same, with another rule and without nods', async () => {
      const {page} = await open(YOU);
      await page.click('#switch-nods');
      for (const [ahead, left] of [
        [1, 0],
        [0, 1],
        [1, 0.3],
        [0, 0],
        [-1, 0],
        [0.37, -0.21],
      ]) {
        await drive(page, 2.5, ahead, left);
      }
      const {hash, ticks} = await play(page, 'play.runs[0].result');
      assert.equal(ticks, 1500);
      const scenario = await download(page, '#save-scenario');
      const commands = await download(page, '#save-drive');
      const words = (await page.textContent('#command'))
        .replace('SCENARIO.toml', scenario)
        .replace('DRIVE.csv', commands)
        .replace('drive.html', folder.at('drive.html'))
        .split(' ');
      assert.equal(words.shift(), 'whisker');
      const native = JSON.parse(whisker(...words, '--json'));
      assert.equal(native.hash, hash);
      assert.match(await page.textContent('#hashes'), new RegExp(hash));
    });

    everybodyCanRead(async (options) => {
      const driven = await open(YOU, options);
      await drive(driven.page, 3, 1, 0.2);
      assert.ok(await driven.page.locator('#stick').isVisible());
      return driven;
    });
  });

  everybodyCanRead(async (options) => {
    const played = await open('', options);
    await played.page.locator('[data-rule="14"]').click();
    await played.page.evaluate(() => window.whisker.play.pass(2));
    return played;
  });
});
