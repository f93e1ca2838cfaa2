// The replay page in a browser.
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {describe, test} from 'node:test';
import {drawn, PHONE, pictureOf, seek, tickOf} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {ROOT, U_TRAP, whisker} from './scenarios.mjs';

describe('the replay page', () => {
  const {folder, openPage} = inBrowser(() => {
    result = folder.run('run', U_TRAP);
  });
  let result;
  const open = (hash = '', options = {}) => openPage(folder.url('run.html', hash), options);

  test('opens from a file, whole and without a complaint', async () => {
    const {page, complaints} = await open();
    assert.equal(await page.textContent('#title'), 'figure 8: U-trap');
    assert.match(
      await page.textContent('#verdict'),
      new RegExp(`^reached the goal in ${result.time_s.toFixed(1)} s$`),
    );
    assert.match(await page.textContent('#facts'), new RegExp(result.hash));
    for (const id of ['world', 'closeup', 'lanes', 'heat-turn', 'heat-step']) {
      assert.ok((await pictureOf(page, id)).colours > 8, `${id} is empty`);
    }
    assert.equal(await page.locator('.uplot').count(), 3);
    assert.deepEqual(complaints, []);
  });

  test('begins where the beams see something', async () => {
    const {page} = await open();
    const [row, before] = await tickOf(page).then((tick) =>
      [tick, tick - 1].map((i) => folder.trace('run')[i]),
    );
    const read = ({left_m, front_m, right_m}) => [left_m, front_m, right_m].every((m) => m !== '');
    assert.ok(read(row) && !read(before));
    assert.doesNotMatch(await page.textContent('.beams'), /stale|lost/);
    assert.doesNotMatch(await page.textContent('#plot-ranges'), /lost/);
  });

  test('lists what occurs in this run, and claims no more', async () => {
    const keys = async (page) =>
      (await page.locator('.key-list li:visible').allTextContents()).map((key) => key.trim());
    const still = ['stands, scans', 'ground proved clear'];
    const {page} = await open();
    assert.deepEqual(await keys(page), [
      'drives freely',
      'follows a boundary',
      'candidate heading',
      ...still,
    ]);
    assert.ok(await page.isVisible('#course-key'));
    writeFileSync(
      folder.at('three.toml'),
      '[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 5.0\ny_m = 0.0\n' +
        [1.5, 2.8, 4.1].map((x) => `[[disc]]\ncenter = [${x}, 0.05]\nradius_m = 0.2\n`).join(''),
    );
    folder.run('three', folder.at('three.toml'));
    const three = await openPage(folder.url('three.html'));
    assert.deepEqual(await keys(three.page), [
      'drives freely',
      'deflected by the table',
      'candidate heading',
      ...still,
    ]);
    assert.equal(await three.page.textContent('#edges-none'), 'It followed no boundary in this run.');
    assert.doesNotMatch(await three.page.textContent('#run'), /No obstacle/);
    folder.run('thesis', folder.at('three.toml'), '--planner', 'thesis');
    const thesis = await openPage(folder.url('thesis.html'));
    assert.ok((await keys(thesis.page)).includes('deflected by the table'));
    assert.ok(await thesis.page.isVisible('#course-key'));
    // The map planner goes straight in an empty world.
    writeFileSync(
      folder.at('empty.toml'),
      readFileSync(folder.at('three.toml'), 'utf8').split('[[disc]]')[0],
    );
    folder.run('empty', folder.at('empty.toml'), '--planner', 'map');
    const empty = await openPage(folder.url('empty.html'));
    assert.deepEqual(await keys(empty.page), ['drives freely', ...still, 'map: seen free', 'planned path']);
    assert.ok(await empty.page.isHidden('#way-key'));
  });

  test('plays, pauses at the end, and plays again from the start', async () => {
    const {page, complaints} = await open();
    await page.click('#play');
    await page.waitForFunction(() => window.whisker.player.tick > 20);
    assert.equal(await page.getAttribute('#play', 'aria-label'), 'Pause');
    await page.click('#play');
    const paused = await tickOf(page);
    await drawn(page);
    assert.equal(await tickOf(page), paused);
    await page.selectOption('#speed', '64');
    await page.click('#play');
    await page.waitForFunction(() => !window.whisker.player.playing);
    assert.equal(await tickOf(page), result.ticks - 1);
    assert.equal(await page.textContent('#state'), 'arrived');
    await page.selectOption('#speed', '0.1');
    await page.click('#play');
    assert.ok((await tickOf(page)) < result.ticks / 2);
    assert.deepEqual(complaints, []);
  });

  test('shows how well the pose is known', async () => {
    const {page: without} = await open();
    assert.ok(await without.isHidden('#sigma'));
    folder.driveWithSigma('sigma');
    const {page, complaints} = await openPage(folder.url('sigma.html', '#t=30'));
    const [along, across, turn] = await page.evaluate(() => {
      const {run, player} = window.whisker;
      return ['along_m', 'across_m', 'heading_rad'].map((part) => run.column(`sigma_${part}`)[player.tick]);
    });
    assert.ok(along > 0.003 && across > 0.003 && turn > 0);
    assert.equal(
      await page.textContent('#now-sigma'),
      `${(2 * Math.hypot(along, across)).toFixed(2)} m, ${((turn * 360) / Math.PI).toFixed(1)}\u00b0`,
    );
    assert.ok(await page.isVisible('#sigma-key'));
    // Without it, the same tick has another picture.
    const picture = () => page.evaluate(() => document.getElementById('closeup').toDataURL());
    const drawn = await picture();
    const blank = await page.evaluate(() => {
      const {run, player} = window.whisker;
      run.column('sigma_along_m')[player.tick] = 0;
      player.request();
      return new Promise((done) =>
        requestAnimationFrame(() =>
          requestAnimationFrame(() => done(document.getElementById('closeup').toDataURL())),
        ),
      );
    });
    assert.notEqual(drawn, blank);
    assert.deepEqual(complaints, []);
  });

  test('obeys the keyboard', async () => {
    const {page} = await open('#t=10');
    const presses = [
      ['ArrowRight', 1001],
      ['ArrowLeft', 1000],
      ['Shift+ArrowRight', 1100],
      ['Shift+ArrowLeft', 1000],
      ['End', result.ticks - 1],
      ['Home', 0],
    ];
    for (const [key, tick] of presses) {
      await page.keyboard.press(key);
      assert.equal(await tickOf(page), tick, key);
    }
    await page.keyboard.press(']');
    const change = await tickOf(page);
    assert.ok(change > 0);
    const [at, earlier] = await page.evaluate((tick) => {
      const {run} = window.whisker;
      const words = (i) => `${run.mode(i)} ${run.why(i)}`;
      return [words(tick), words(tick - 1)];
    }, change);
    assert.notEqual(at, earlier);
    await page.keyboard.press('[');
    assert.equal(await tickOf(page), 0);
    await page.keyboard.press('+');
    assert.equal(await page.inputValue('#speed'), '2');
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => window.whisker.player.playing), true);
    await page.keyboard.press(' ');
    assert.equal(await page.evaluate(() => window.whisker.player.playing), false);
    await page.keyboard.press('f');
    assert.equal(await page.getAttribute('#follow', 'aria-pressed'), 'true');
    await page.keyboard.press('0');
    assert.equal(await page.getAttribute('#follow', 'aria-pressed'), 'false');
    await page.keyboard.press('?');
    assert.ok(await page.isVisible('#keys'));
    await page.keyboard.press('Escape');
    assert.ok(!(await page.isVisible('#keys')));
  });

  test('every control can be reached by the keyboard alone', async () => {
    const {page} = await open();
    const reached = new Set();
    for (let i = 0; i < 40; ++i) {
      await page.keyboard.press('Tab');
      reached.add(await page.evaluate(() => document.activeElement?.id));
    }
    for (const id of [
      'play',
      'scrub',
      'speed',
      'copy',
      'follow',
      'fit',
      'theme',
      'help',
      'zoom',
      'zoom-goal',
    ]) {
      assert.ok(reached.has(id), `${id} was not reached`);
    }
    await page.focus('#scrub');
    const before = await tickOf(page);
    await page.keyboard.press('ArrowRight');
    assert.equal(await tickOf(page), before + 1, 'the slider moves by one tick');
  });

  test('scrubs, and everything follows', async () => {
    const {page} = await open();
    const box = await page.locator('#lanes').boundingBox();
    const seen = [];
    await page.mouse.move(box.x + 2, box.y + 10);
    await page.mouse.down();
    for (const part of [0.2, 0.5, 0.8]) {
      await page.mouse.move(box.x + part * box.width, box.y + 10, {steps: 3});
      await drawn(page);
      const tick = await tickOf(page);
      assert.ok(Math.abs(tick - part * result.ticks) < 0.02 * result.ticks, `${tick} is not at ${part}`);
      seen.push([
        await pictureOf(page, 'world'),
        await pictureOf(page, 'closeup'),
        await page.textContent('#now-time'),
      ]);
    }
    await page.mouse.up();
    for (const i of [0, 1]) {
      assert.notEqual(new Set(seen.map((picture) => picture[i].sum)).size, 1, 'the picture stands still');
    }
    assert.equal(new Set(seen.map((picture) => picture[2])).size, 3);
    const head = await page.locator('#lanes-head').boundingBox();
    assert.ok(Math.abs(head.x - (box.x + 0.8 * box.width)) < 6, 'the playhead is elsewhere');
  });

  test('the world zooms under the wheel, moves under the mouse, and comes back', async () => {
    const {page} = await open('#t=5');
    const box = await page.locator('#world').boundingBox();
    const whole = await pictureOf(page, 'world');
    await page.mouse.move(box.x + 200, box.y + 200);
    await page.mouse.wheel(0, -400);
    // The wheel's event comes some frames later.
    let zoomed = whole;
    for (let frame = 0; frame < 50 && zoomed.sum === whole.sum; ++frame) {
      await drawn(page);
      zoomed = await pictureOf(page, 'world');
    }
    assert.notEqual(zoomed.sum, whole.sum);
    await page.mouse.down();
    await page.mouse.move(box.x + 260, box.y + 240, {steps: 4});
    await page.mouse.up();
    await drawn(page);
    assert.notEqual((await pictureOf(page, 'world')).sum, zoomed.sum);
    await page.click('#fit');
    await drawn(page);
    assert.equal((await pictureOf(page, 'world')).sum, whole.sum);
  });

  test('links to a tick, and writes the link', async () => {
    const {page} = await open('#t=12.34');
    assert.equal(await tickOf(page), 1234);
    assert.equal(await page.textContent('#clock'), '12.34 s');
    await page.keyboard.press('ArrowRight');
    await drawn(page);
    await page.waitForFunction(() => location.hash === '#t=12.35');
    await page.evaluate(() => (location.hash = '#t=3'));
    await page.waitForFunction(() => window.whisker.player.tick === 300);
    const late = await open('#t=99999');
    assert.equal(await tickOf(late.page), result.ticks - 1);
    const nonsense = await open('#t=soon');
    assert.equal(await tickOf(nonsense.page), await tickOf((await open()).page));
    assert.deepEqual(nonsense.complaints, []);
  });

  test('nothing stands that moves', async () => {
    folder.drive('enclosed', ['enclosed', '--noise', '--seed', 2]);
    const {page} = await openPage(folder.url('enclosed.html', '#t=99999'));
    assert.ok(parseFloat(await page.textContent('#now-speed')) > 0.1, 'it is still fast when it knows');
    assert.match(await page.textContent('#sentence'), /^Comes to a stand: the goal cannot be reached/);
  });

  test('where the beams read otherwise than the table was asked, it says so', async () => {
    const scenario = folder.at('false_clear.toml');
    whisker('world', 'discs', '--seed', 3, '--out', scenario);
    writeFileSync(scenario, `${readFileSync(scenario, 'utf8')}\n[noise]\nrange_false_clear = 0.9\n`);
    const {outcome} = folder.run('false_clear', scenario, '--planner', 'thesis');
    assert.equal(outcome, 'contact');
    const {page} = await openPage(folder.url('false_clear.html', '#t=99'));
    const found = await page.evaluate(() => {
      const {run} = window.whisker;
      for (let tick = run.ticks - 1; tick > 0; --tick) {
        const [d, sa] = ['d', 'sa'].map((name) => run.column(name)[tick]);
        const steered = ['steering', 'stepping'].includes(run.mode(tick));
        const read = (10 * run.range(1, tick)) / run.info.robot.max_range;
        if (steered && sa !== 0 && Math.abs(d - read) > 2) return tick;
      }
      return -1;
    });
    assert.ok(found > 0);
    await seek(page, found);
    assert.match(
      await page.textContent('#table-says'),
      /^SA bends the course \d+° to the (left: right|right: left) is near\. It asked earlier readings, on which the beams agreed\.$/,
    );
    assert.doesNotMatch(await page.textContent('#run'), /distance ahead, now/);
  });

  test('an obstacle on the left is on the left, and colours mean the same in all pictures', async () => {
    const {page} = await open();
    const colours = await page.evaluate(() => {
      const canvas = document.getElementById('heat-turn');
      const at = (x, y) => [
        ...canvas.getContext('2d').getImageData(x * canvas.width, y * canvas.height, 1, 1).data,
      ];
      return [at(0.25, 0.75), at(0.85, 0.75)];
    });
    const blue = ([r, , b]) => b > r;
    // Near ahead: the left nearer turns right, blue, as in `whisker table --svg`.
    assert.deepEqual(colours.map(blue), [true, false]);
  });

  test('says what it does and why', async () => {
    const {page} = await open();
    const tick = await page.evaluate(() => {
      const {run} = window.whisker;
      for (let i = 0; i < run.ticks; ++i) if (run.mode(i) === 'skirting' && run.why(i) === 'edge') return i;
      return -1;
    });
    await seek(page, tick);
    assert.match(await page.textContent('#sentence'), /Follows the boundary/);
    assert.match(await page.textContent('#leave-rule'), /it may leave below \d/);
    assert.match(
      await page.textContent('#table-says'),
      /Neither answer changes anything now: the robot follows a boundary/,
    );
    assert.equal(await page.locator('#edge-rows tr.current').count(), 1);
    await page.click('#edge-rows button');
    await drawn(page);
    assert.equal(await tickOf(page), await page.evaluate(() => window.whisker.run.info.edges[0].hit));
  });

  test('leave points are nearer to the goal than the hit points before', async () => {
    const {page} = await open();
    const rows = await page.locator('#edge-rows tr').allTextContents();
    assert.ok(rows.length > 0);
    for (const row of rows) assert.match(row, /s\d+\.\d+ m\d+\.\d+ m\d+\.\d+ m$/);
  });

  test('plots follow the time and lead to it', async () => {
    const {page} = await open('#t=5');
    const head = page.locator('#plot-ranges .playhead');
    const early = (await head.boundingBox()).x;
    await seek(page, 2000);
    assert.ok((await head.boundingBox()).x > early + 50);
    const plot = page.locator('#plot-ranges .u-over');
    const {width} = await plot.boundingBox();
    await plot.click({position: {x: width / 2, y: 20}});
    await drawn(page);
    assert.ok(Math.abs((await tickOf(page)) - result.ticks / 2) < 0.02 * result.ticks);
    await page.click('#zoom');
    await drawn(page);
    const box = await page.locator('#plot-ranges .u-over').boundingBox();
    assert.ok(
      Math.abs((await head.boundingBox()).x - (box.x + 0.75 * box.width)) < 4,
      'now is not at three quarters',
    );
  });

  test('no label of a plot is cut, wherever its ticks are', async () => {
    folder.run('gentle', join(ROOT, 'tests/cli/scenarios/crossing_mover.toml'));
    whisker('guard', U_TRAP, '--operator', 'sloppy', '--html', folder.at('guard.html'));
    for (const name of ['run', 'gentle', 'guard']) {
      const {page} = await openPage(folder.url(`${name}.html`));
      const cut = await page.evaluate(async () => {
        const found = new Set();
        const fillText = CanvasRenderingContext2D.prototype.fillText;
        CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
          if (this.canvas.closest('.plot')) {
            const {actualBoundingBoxLeft: left, actualBoundingBoxRight: right} = this.measureText(text);
            const at = this.getTransform().transformPoint({x, y}).x;
            if (at - left < 0 || at + right > this.canvas.width) found.add(text);
          }
          fillText.call(this, text, x, y);
        };
        const {player, run} = window.whisker;
        const frames = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
        document.getElementById('theme').click();
        await frames();
        document.querySelector('.plot-buttons button').click();
        for (let i = 0; i <= 20; ++i) {
          player.seek(Math.floor(((run.ticks - 1) * i) / 20));
          await frames();
        }
        return [...found];
      });
      assert.deepEqual(cut, [], name);
    }
  });

  test('light and dark, by the system and by the button', async () => {
    const ground = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const [light, dark] = [await open('#t=8'), await open('#t=8', {colorScheme: 'dark'})];
    const [lightGround, darkGround] = [await ground(light.page), await ground(dark.page)];
    assert.notEqual(lightGround, darkGround);
    const before = await pictureOf(light.page, 'world');
    await light.page.click('#theme');
    await drawn(light.page);
    assert.equal(await ground(light.page), darkGround);
    assert.notEqual((await pictureOf(light.page, 'world')).sum, before.sum);
    await dark.page.keyboard.press('d');
    assert.equal(await ground(dark.page), lightGround);
    assert.deepEqual([...light.complaints, ...dark.complaints], []);
  });

  for (const [name, viewport] of [
    ['a phone', PHONE],
    ['a small phone', {width: 320, height: 568}],
    ['a phone on its side', {width: 844, height: 390}],
    ['a small window', {width: 800, height: 600}],
    ['a flat window', {width: 1280, height: 520}],
    ['a low window', {width: 1180, height: 580}],
    ['a tablet', {width: 820, height: 1180}],
  ]) {
    test(`fits ${name}`, async () => {
      const {page, complaints} = await open('#t=8', {
        viewport,
        touch: true,
      });
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), viewport.width);
      const wide = await page.evaluate(() =>
        [...document.querySelectorAll('main *')]
          .filter(
            (e) =>
              e.id !== 'scrub' && e.getBoundingClientRect().right > innerWidth + 0.5 && !e.closest('.scroll'),
          )
          .map((e) => e.id || e.className || e.tagName),
      );
      assert.deepEqual(wide, []);
      const inSight = (id) =>
        page.evaluate((name) => {
          const {top, bottom} = document.getElementById(name).getBoundingClientRect();
          return top >= 0 && bottom <= innerHeight;
        }, id);
      for (const id of ['play', 'lanes', 'clock']) assert.ok(await inSight(id), `${id} is out of sight`);
      const world = await page.locator('#world').boundingBox();
      const bar = await page.locator('.transport').boundingBox();
      const seen = Math.min(world.y + world.height, bar.y) - world.y;
      assert.ok(seen > 100, `${seen} px of the world`);
      await page.tap('#play');
      await page.waitForFunction(() => window.whisker.player.tick > 830);
      assert.deepEqual(complaints, []);
    });
  }

  everybodyCanRead((options) => open('#t=10', options));

  test('a moving obstacle is where the simulator has it', async () => {
    folder.run('mover', join(ROOT, 'tests/cli/scenarios/crossing_mover.toml'));
    const {page, complaints} = await openPage(folder.url('mover.html', '#t=2'));
    const still = await pictureOf(page, 'world');
    await seek(page, 250);
    assert.notEqual((await pictureOf(page, 'world')).sum, still.sum);
    assert.deepEqual(complaints, []);
  });

  for (const [name, words] of [
    ['blind', /stopped with a fault after 1\.\d s/],
    ['run_over', /touched an obstacle after 0\.\d s/],
    ['goal_at_start', /reached the goal in 0\.0 s/],
    ['no_time', /gave up after/],
    ['bad_wheels', /^believes it is there; is \d\.\d\d m off, after \d+\.\d s$/],
  ]) {
    test(`opens the short run ${name} at its end and at its beginning`, async () => {
      folder.run(name, join(ROOT, `tests/cli/scenarios/${name}.toml`));
      const {page, complaints} = await openPage(folder.url(`${name}.html`, '#t=999'));
      assert.match(await page.textContent('#verdict'), words);
      await page.click('#play');
      await page.waitForFunction(() => !window.whisker.player.playing);
      await seek(page, 0);
      assert.deepEqual(complaints, []);
    });
  }

  test('a robot that only believes to be there is not shown as one that is', async () => {
    const looks = (page) =>
      page.evaluate(() => {
        const colour = (name) =>
          getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
        const shown = document.createElement('i');
        document.body.append(shown);
        const rgb = (name) => {
          shown.style.color = colour(name);
          return getComputedStyle(shown).color;
        };
        return {
          verdict: getComputedStyle(document.getElementById('verdict')).color,
          chip: document.getElementById('state').style.getPropertyValue('--chip').trim(),
          goal: rgb('goal'),
          contact: rgb('contact'),
          goalChip: colour('goal'),
        };
      });
    const off = folder.run('off', join(ROOT, 'tests/cli/scenarios/bad_wheels.toml'));
    assert.equal(off.outcome, 'off_goal');
    const {page, complaints} = await openPage(folder.url('off.html', '#t=999'));
    const words = `believes it is there; is ${off.final_distance_m.toFixed(2)} m off, after`;
    assert.ok((await page.textContent('#verdict')).startsWith(words));
    assert.ok(
      whisker('run', join(ROOT, 'tests/cli/scenarios/bad_wheels.toml')).startsWith(words),
      'as the command says',
    );
    const wrong = await looks(page);
    assert.equal(wrong.verdict, wrong.contact);
    assert.notEqual(wrong.chip, wrong.goalChip);
    const facts = await page.textContent('#facts');
    assert.match(facts, new RegExp(`from the goal at the end${off.final_distance_m.toFixed(3)} m`));
    assert.match(facts, new RegExp(`by its own estimate${off.believed_distance_m.toFixed(3)} m`));
    assert.match(await page.textContent('#sentence'), /by its own estimate it is at the goal/);
    const right = await looks((await open('#t=999')).page);
    assert.equal(right.verdict, right.goal);
    assert.equal(right.chip, right.goalChip);
    assert.deepEqual(complaints, []);
  });

  test('of a log nobody knows where the robot truly was', async () => {
    const log = folder.at('run.log');
    whisker('hil', U_TRAP, '--record', log);
    whisker('replay', log, '--html', folder.at('log.html'));
    const {page, complaints} = await openPage(folder.url('log.html', '#t=999'));
    assert.match(await page.textContent('#verdict'), /^believes it is there after \d+\.\d s$/);
    assert.equal(await page.getAttribute('#verdict', 'data-outcome'), 'believed');
    assert.match(await page.textContent('#facts'), /from the goal at the endnot known here/);
    assert.deepEqual(complaints, []);
  });

  test('ten minutes at 100 Hz stay below 5 MB, and open', async () => {
    const long = folder.tenMinutes('long');
    assert.equal(long.ticks, 60001);
    assert.ok(statSync(folder.at('long.html')).size < 5e6);
    const {page, complaints} = await openPage(folder.url('long.html', '#t=599.99'));
    assert.equal(await tickOf(page), 59999);
    assert.deepEqual(complaints, []);
  });
});
