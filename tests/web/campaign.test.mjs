// The page of a campaign in a browser.
import assert from 'node:assert/strict';
import {readFileSync, statSync, writeFileSync} from 'node:fs';
import {describe, test} from 'node:test';
import {drawn, PHONE, pictureOf, tickOf} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {whisker, withoutOrigin} from './scenarios.mjs';

const MISSIONS = ['campaign', 'u-trap', '--count', 12, '--planner', 'bug2'];

describe('the page of a campaign', () => {
  const {folder, openPage} = inBrowser(() => {
    summary = JSON.parse(whisker(...MISSIONS, '--json', '--html', folder.at('campaign.html')));
  });
  let summary;
  const open = (hash = '', options = {}) => openPage(folder.url('campaign.html', hash), options);

  test('shows outcomes, spreads and ways', async () => {
    const {page, complaints} = await open();
    const rows = await page.locator('#shares tr').allTextContents();
    assert.match(rows[0], /^truly there/);
    const share = (name) => rows.find((row) => row.startsWith(name));
    for (const [name, key] of [
      ['truly there', 'truly_there'],
      ['says it is there', 'reached'],
      ['gave up', 'gave_up'],
      ['contact', 'contact'],
    ]) {
      const count = Math.round(summary[key].value * 12);
      assert.match(share(name), new RegExp(`^${name}${count}${(100 * summary[key].value).toFixed(1)} %`));
    }
    assert.equal(await page.locator('.histogram').count(), 4);
    assert.ok((await pictureOf(page, 'scatter')).colours > 8);
    assert.deepEqual(complaints, []);
  });

  test('does not count belief for truth', async () => {
    const noisy = ['discs', '--count', 6, '--noise', '--wheel-scale-sigma', 0.005, '--seed', 11];
    const file = folder.at('noisy.html');
    const told = JSON.parse(whisker('campaign', ...noisy, '--json', '--html', file));
    assert.equal(told.truly_there.value, 0);
    assert.equal(told.reached.value, 1);
    const {page, complaints} = await openPage(folder.url('noisy.html'));
    const rows = await page.locator('#shares tr').allTextContents();
    assert.match(rows[0], /^truly there00\.0 %/);
    const verdicts = page.locator('#replays tr td:nth-child(3)');
    const off = (await verdicts.allTextContents()).map((text) => {
      assert.match(text, /^believes it is there; is \d+\.\d\d m off$/);
      return Number(text.match(/is (\S+) m/)[1]);
    });
    assert.deepEqual(
      off,
      [...off].sort((a, b) => b - a),
      'the farthest off first',
    );
    assert.equal(await page.locator('#replays td.bad').count(), off.length);
    assert.deepEqual(complaints, []);
  });

  test('puts the worst first, and replays them', async () => {
    const {page, complaints} = await open();
    const verdicts = await page.locator('#replays tr td:nth-child(3)').allTextContents();
    assert.equal(verdicts.length, 12);
    const failed = verdicts.map((verdict) => verdict !== 'reached the goal');
    assert.deepEqual(
      failed,
      [...failed].sort((a, b) => b - a),
    );
    await page.click('#replays tr:nth-child(2) a');
    await page.waitForFunction(() => window.whisker);
    await drawn(page);
    const seed = await page.evaluate(() => window.whisker.run.info.seed);
    const [again] = await page.evaluate(() => [window.whisker.run.info.result]);
    assert.deepEqual(
      withoutOrigin(
        JSON.parse(whisker('campaign', 'u-trap', '--planner', 'bug2', '--replay', seed, '--json')),
      ),
      again,
    );
    assert.match(await page.textContent('#facts'), new RegExp(`--replay ${seed} `));
    await page.click('#to-campaign');
    await page.waitForFunction(() => document.body.dataset.view === 'campaign');
    assert.deepEqual(complaints, []);
  });

  test('every mission of a hundred opens, in a page of less than 3 MB', async () => {
    const file = folder.at('hundred.html');
    const rows = whisker(
      'campaign',
      'maze',
      '--noise',
      '--count',
      100,
      '--seed',
      201,
      '--html',
      file,
      '--csv',
      folder.at('hundred.csv'),
    );
    assert.ok(rows.length > 0 && statSync(file).size < 3e6, `${statSync(file).size} bytes`);
    const {page, complaints} = await openPage(folder.url('hundred.html'));
    assert.equal(await page.locator('#replays tr').count(), 20);
    await page.click('#replays-all');
    assert.equal(await page.locator('#replays a').count(), 100);
    assert.equal(await page.textContent('#replays-note'), '');
    const trace = folder.trace('hundred');
    for (const i of [0, 19, 57, 99]) {
      const mission = await openPage(folder.url('hundred.html', `#run=${i}&t=99999`));
      const {seed, t, x, result} = await mission.page.evaluate(() => {
        const {run, player} = window.whisker;
        return {
          seed: run.info.seed,
          t: run.t[player.tick],
          x: [...run.column('x_m')],
          result: run.info.result,
        };
      });
      const row = trace.find((one) => Number(one.seed) === seed);
      assert.equal(result.hash, row.hash);
      assert.ok(Math.abs(t - Number(row.time_s)) < 0.011, `the last tick is at ${t}`);
      assert.ok(x.length < Number(row.time_s) * 5 + 3);
      assert.match(await mission.page.textContent('#facts'), /five ticks a second/);
      assert.equal(await mission.page.textContent('#now-tick'), `tick ${Math.round(t * 100)}`);
      assert.deepEqual(mission.complaints, []);
    }
    assert.deepEqual(complaints, []);
  });

  test('a mission that the page has no room for says how to drive it', async () => {
    // As the tool writes it for a campaign that is larger than that.
    const html = readFileSync(folder.at('campaign.html'), 'utf8').replace(
      /(id="data">)(.*?)(<\/script>)/s,
      (_, before, text, behind) => {
        const data = JSON.parse(text);
        const {row, command} = data.runs.pop();
        data.campaign.commands[row] = command;
        return before + JSON.stringify(data).replaceAll('<', '\\u003c') + behind;
      },
    );
    writeFileSync(folder.at('cut.html'), html);
    const {page, complaints} = await openPage(folder.url('cut.html'));
    assert.match(await page.textContent('#replays-note'), /room for 11 of 12 missions/);
    await page.evaluate(() =>
      Object.defineProperty(navigator, 'clipboard', {
        value: {writeText: async (text) => (window.copied = text)},
      }),
    );
    await page.click('#replays button');
    await page.waitForFunction(() => window.copied);
    assert.match(
      await page.evaluate(() => window.copied),
      /^whisker campaign u-trap --replay \d+ --planner bug2/,
    );
    assert.deepEqual(complaints, []);
  });

  test('links to a tick of a replay', async () => {
    const {page} = await open('#run=3&t=1.6');
    assert.equal(await tickOf(page), 8);
    assert.equal(await page.textContent('#now-tick'), 'tick 160');
    assert.equal(await page.evaluate(() => window.whisker.run.info.row !== undefined), true);
  });

  test('a link to a mission that it does not have is said', async () => {
    for (const hash of ['#run=12', '#run=2.5']) {
      const {page, complaints} = await open(hash);
      assert.match(await page.textContent('#link-fault:visible'), /a run that is not in this page/);
      assert.ok(await page.isVisible('#replays'));
      assert.deepEqual(complaints, []);
    }
  });

  test('fits a phone, and shades the side where a table goes on', async () => {
    for (const colorScheme of ['light', 'dark']) {
      const {page} = await open('', {viewport: PHONE, colorScheme});
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), PHONE.width);
      const [shares, missions] = await page.locator('.scroll').all();
      assert.ok(await shares.evaluate((e) => e.scrollWidth <= e.clientWidth), 'the outcomes are cut');
      assert.ok(await missions.evaluate((e) => e.scrollWidth > e.clientWidth), 'the missions need no sign');
      await missions.scrollIntoViewIfNeeded();
      // A column of pixels at each side, without what the table has there.
      const sides = async () => {
        const png = await missions.screenshot({style: 'table { visibility: hidden }'});
        return page.evaluate(async (base64) => {
          const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
          const picture = await createImageBitmap(new Blob([bytes], {type: 'image/png'}));
          const c = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
          c.drawImage(picture, 0, 0);
          const at = (x) => c.getImageData(x, picture.height >> 1, 1, 1).data.join();
          return [at(1), at(picture.width - 2), at(picture.width >> 1)];
        }, png.toString('base64'));
      };
      const scrolledTo = (x) => missions.evaluate((e, to) => (e.scrollLeft = to), x).then(() => drawn(page));
      const shaded = async () => {
        const [left, right, panel] = await sides();
        return [left !== panel, right !== panel];
      };
      await scrolledTo(0);
      assert.deepEqual(await shaded(), [false, true]);
      await scrolledTo(1e4);
      assert.deepEqual(await shaded(), [true, false]);
    }
  });

  everybodyCanRead((options) => open('', options));
});
