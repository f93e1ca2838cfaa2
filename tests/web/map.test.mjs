// The map of the map planner on the replay page.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {describe, test} from 'node:test';
import {drawn, pictureOf, seek} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {whisker} from './scenarios.mjs';

const KEYS = ['map: seen free', 'suspect', 'occupied', 'planned path'];

describe('the map on the replay page', () => {
  const {folder, openPage} = inBrowser(() => {
    folder.drive('map', ['rooms', '--seed', 9], '--planner', 'map');
    folder.drive('drifting', ['rooms', '--seed', 4, '--noise'], '--planner', 'map', '--map-bytes', 1024);
  });
  const open = (name = 'map', hash = '', options = {}) => openPage(folder.url(`${name}.html`, hash), options);
  const keys = (page) => page.locator('[data-state]:visible').allTextContents();

  test('is said in the head, drawn, and hidden again', async () => {
    const {page, complaints} = await open('map', '#t=40');
    assert.equal(await page.textContent('#planner-name'), 'map planner, 2048 bytes');
    assert.match(await page.textContent('#facts'), /map planner, 2048 bytes/);
    assert.match(await page.textContent('.what'), /rangefinders and a map of 2048 bytes drives/);
    assert.match(await page.textContent('#planner-of-progress'), /The map leads/);
    assert.deepEqual(await keys(page), KEYS);
    const shown = await pictureOf(page, 'world');
    await page.keyboard.press('m');
    await drawn(page);
    const hidden = await pictureOf(page, 'world');
    assert.notEqual(hidden.sum, shown.sum);
    assert.equal(await page.getAttribute('#show-map', 'aria-pressed'), 'false');
    assert.deepEqual(await keys(page), []);
    await page.click('#show-map');
    await drawn(page);
    assert.equal((await pictureOf(page, 'world')).sum, shown.sum);
    assert.deepEqual(await keys(page), KEYS);
    assert.deepEqual(complaints, []);
  });

  for (const name of ['map', 'drifting']) {
    test(`of ${name} is the same whichever way one comes to a tick, and the robot is on free ground`, async () => {
      const {page} = await open(name);
      const {forth, back, window} = await page.evaluate(() => {
        const {run} = window.whisker;
        const {columns, rows, cell} = run.map.info;
        const look = (tick) => {
          const picture = run.map.seek(tick);
          const [left, bottom] = run.map.corner;
          const counts = [0, 0, 0, 0];
          let [way, sum] = [0, 0];
          for (let y = bottom; y < bottom + rows; ++y) {
            for (let x = left; x < left + columns; ++x) {
              const state = run.map.state(x, y);
              ++counts[state];
              if (run.map.onWay(x, y)) ++way;
              sum = (Math.imul(sum, 31) + state) | 0;
            }
          }
          const at = (name) => Math.floor(run.column(name)[picture] / cell);
          return {picture, counts, way, sum, under: run.map.state(at('est_x_m'), at('est_y_m'))};
        };
        const ticks = Array.from({length: 40}, (_, i) => Math.floor(((run.ticks - 1) * i) / 39));
        const forth = ticks.map(look);
        return {forth, back: ticks.reverse().map(look).reverse(), window: {columns, rows}};
      });
      assert.deepEqual(forth, back);
      assert.deepEqual(window, name === 'map' ? {columns: 64, rows: 56} : {columns: 32, rows: 48});
      assert.ok(new Set(forth.map(({sum}) => sum)).size > 30, 'the map never changes');
      const middle = forth.slice(1, -1);
      assert.ok(middle.filter(({under}) => under === 1).length > 35, 'the robot is not on free ground');
      assert.ok(middle.filter(({way}) => way > 3).length > 8, 'there is no plan');
      for (const {counts} of middle) assert.ok(counts[1] > 20, `${counts}`);
      assert.ok(middle.filter(({counts}) => counts[3] > 5).length > 20, 'nothing is occupied');
    });
  }

  test('has a lane with its hand-overs', async () => {
    // The map leads there; boundary following finds that there is no way in.
    folder.drive('enclosed', ['enclosed', '--seed', 2], '--planner', 'map');
    const {page} = await open('enclosed');
    assert.ok(await page.isVisible('#lane-map'));
    const handOvers = await page.evaluate(() => {
      const {run} = window.whisker;
      const all = [];
      const led = (tick) => run.guide(tick) !== 'none';
      for (let tick = 1; tick < run.ticks; ++tick) if (led(tick) !== led(tick - 1)) all.push(tick);
      return all;
    });
    assert.ok(handOvers.length >= 2, 'it begins to lead, and hands over');
    const colourAt = (tick) =>
      page.evaluate((at) => {
        const canvas = document.getElementById('lanes');
        const x = Math.round(((at + 0.5) / window.whisker.run.ticks) * canvas.width);
        const y = canvas.height - 2;
        return [...canvas.getContext('2d').getImageData(x, y, 1, 1).data].join();
      }, tick);
    const [toMap, toBoundary] = handOvers;
    const onBoundary = await colourAt(toBoundary + 500);
    assert.notEqual(onBoundary, await colourAt((toMap + toBoundary) / 2));
    assert.notEqual(onBoundary, await colourAt(toMap / 2));
  });

  test('leads to a place that is drawn', async () => {
    const {page} = await open();
    const tick = await page.evaluate(() => {
      const {run} = window.whisker;
      for (let i = 0; i < run.ticks; ++i) if (run.guide(i) === 'place') return i;
      return -1;
    });
    const [x, y] = await page.evaluate((at) => {
      const {run} = window.whisker;
      return [run.column('way_x_m')[at], run.column('way_y_m')[at]];
    }, tick);
    const row = folder.trace('map')[tick];
    assert.ok(Math.abs(x - Number(row.way_x_m)) < 6e-7 && Math.abs(y - Number(row.way_y_m)) < 6e-7);
    await seek(page, tick - 1);
    const before = await pictureOf(page, 'world');
    await seek(page, tick);
    assert.notEqual((await pictureOf(page, 'world')).sum, before.sum);
    assert.match(await page.textContent('#sentence'), /^Drives to the next way point of its map/);
    assert.ok(await page.isVisible('#way-key'));
  });

  test('is not there for the boundary planner', async () => {
    folder.drive('skirt', ['u-trap', '--seed', 7], '--planner', 'skirt');
    const {page, complaints} = await open('skirt', '#t=8');
    assert.equal(await page.textContent('#planner-name'), 'boundary planner');
    assert.match(await page.textContent('.what'), /rangefinders and no map drives/);
    assert.deepEqual(await keys(page), []);
    assert.ok(await page.isHidden('#show-map'));
    assert.ok(await page.isHidden('#lane-map'));
    await page.keyboard.press('m');
    assert.deepEqual(complaints, []);
  });

  test('is there on a bus of this computer, and in the replay of its log', async () => {
    const [world, log] = [folder.at('map.toml'), folder.at('map.log')];
    const options = ['--planner', 'map', '--json'];
    const {hash} = JSON.parse(
      whisker('hil', world, '--record', log, '--html', folder.at('hil.html'), ...options),
    );
    whisker('replay', log, '--html', folder.at('log.html'), ...options);
    const onBus = await open('hil', '#t=40');
    assert.equal(await onBus.page.textContent('#planner-name'), 'map planner, 2048 bytes');
    assert.ok(await onBus.page.isVisible('#show-map'));
    assert.ok(await onBus.page.isHidden('#map-unknown'));
    assert.deepEqual(await keys(onBus.page), KEYS);
    const logged = await open('log', '#t=40');
    assert.match(await logged.page.textContent('#facts'), new RegExp(hash));
    assert.ok(await logged.page.isVisible('#show-map'));
    assert.deepEqual(await keys(logged.page), KEYS);
    assert.deepEqual([...onBus.complaints, ...logged.complaints], []);
  });

  test('changes by few words from picture to picture', () => {
    const page = readFileSync(folder.at('map.html'), 'utf8');
    const run = JSON.parse(page.match(/id="data">(.*?)<\/script>/s)[1]).runs[0];
    const count = (name) => run.columns.find(([column]) => column === name)[3];
    assert.ok(count('map_tick') > 100, `${count('map_tick')} pictures`);
    // A change is a word's number and its bits: five bytes or so, and these deflate.
    assert.ok(count('map_word') < 20 * count('map_tick'), `${count('map_word')} changes`);
  });

  everybodyCanRead((options) => open('map', '#t=40', options));
});
