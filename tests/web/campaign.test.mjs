// The page of a campaign in a browser.
import assert from 'node:assert/strict';
import {after, afterEach, before, describe, test} from 'node:test';
import {
  accessibilityFaults,
  drawn,
  closePages,
  launch,
  openPage,
  PHONE,
  pictureOf,
  tickOf,
} from './browser.mjs';
import {Folder, whisker} from './scenarios.mjs';

const MISSIONS = ['campaign', 'u-trap', '--count', 12, '--planner', 'bug2'];

describe('the page of a campaign', () => {
  const folder = new Folder();
  let browser;
  let summary;
  before(async () => {
    summary = JSON.parse(whisker(...MISSIONS, '--json', '--html', folder.at('campaign.html')));
    browser = await launch();
  });
  afterEach(() => closePages(browser));
  after(async () => {
    await browser?.close();
    folder.remove();
  });
  const open = (hash = '', options = {}) => openPage(browser, folder.url('campaign.html', hash), options);

  test('shows outcomes, spreads and ways', async () => {
    const {page, complaints} = await open();
    const rows = await page.locator('#shares tr').allTextContents();
    const share = (name) => rows.find((row) => row.startsWith(name));
    for (const [name, key] of [
      ['reached', 'reached'],
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

  test('puts the worst first, and replays them', async () => {
    const {page, complaints} = await open();
    const verdicts = await page.locator('#replays tr td:nth-child(3)').allTextContents();
    assert.equal(verdicts.length, 8);
    const failed = verdicts.map((verdict) => verdict !== 'reached');
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
      JSON.parse(whisker('campaign', 'u-trap', '--planner', 'bug2', '--replay', seed, '--json')),
      again,
    );
    assert.match(await page.textContent('#facts'), new RegExp(`--replay ${seed} `));
    await page.click('#to-campaign');
    await page.waitForFunction(() => document.body.dataset.view === 'campaign');
    assert.deepEqual(complaints, []);
  });

  test('links to a tick of a replay', async () => {
    const {page} = await open('#run=3&t=1.5');
    assert.equal(await tickOf(page), 150);
    assert.equal(await page.evaluate(() => window.whisker.run.info.row !== undefined), true);
  });

  test('fits a phone', async () => {
    const {page} = await open('', {viewport: PHONE});
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), PHONE.width);
  });

  for (const colorScheme of ['light', 'dark']) {
    test(`axe finds no fault: ${colorScheme}`, async () => {
      const {page} = await open('', {colorScheme});
      assert.deepEqual(await accessibilityFaults(page), []);
    });
  }
});
