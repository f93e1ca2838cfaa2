// The addresses of the pages: as links that are made, copied and followed, and as links that somebody made to harm.
import assert from 'node:assert/strict';
import {join} from 'node:path';
import {describe, test} from 'node:test';
import {deflateSync} from 'node:zlib';
import {seek} from './browser.mjs';
import {inBrowser} from './in_browser.mjs';
import {ROOT, U_TRAP} from './scenarios.mjs';

const PLAYGROUND = process.env.PLAYGROUND ?? join(ROOT, 'out/playground/index.html');

describe('links', () => {
  const {folder, openPage} = inBrowser(() => {
    folder.run('run', U_TRAP);
  });
  const openReplay = (hash = '') => openPage(folder.url('run.html', hash));
  const openPlayground = (hash) => openPage(`file://${PLAYGROUND}${hash}`, {reducedMotion: 'reduce'});
  const play = (page, look) => page.evaluate(`(({play}) => (${look}))(window.whisker)`);

  test('while it is scrubbed the address follows at a pace that browsers take, and ends where it stands', async () => {
    const {page} = await openReplay();
    await page.evaluate(async () => {
      const write = history.replaceState.bind(history);
      window.written = 0;
      const begun = performance.now();
      history.replaceState = (...all) => {
        ++window.written;
        write(...all);
      };
      for (let i = 1; i <= 90; ++i) {
        window.whisker.player.seek(10 * i);
        await new Promise((done) => requestAnimationFrame(done));
      }
      window.took_ms = performance.now() - begun;
    });
    await page.waitForFunction(() => location.hash === '#t=9');
    const {written, took_ms} = await page.evaluate(() => ({
      written: window.written,
      took_ms: window.took_ms,
    }));
    // One at the beginning, one at the end.
    assert.ok(written > 1 && written <= took_ms / 400 + 2, `${written} times in ${took_ms} ms`);
  });

  test('the copied link is that to the tick shown, whatever the address says', async () => {
    const {page} = await openReplay('#t=1');
    await page.evaluate(() => {
      history.replaceState = () => {};
      Object.defineProperty(navigator, 'clipboard', {
        value: {writeText: async (text) => (window.copied = text)},
      });
    });
    await seek(page, 765);
    await page.click('#copy');
    await page.waitForFunction(() => window.copied);
    assert.equal(await page.evaluate(() => window.copied), folder.url('run.html', '#t=7.65'));
  });

  test('a part that no page knows is said, on both pages', async () => {
    for (const hash of ['#wrold=maze&seed=3', '#maze', '#t=31']) {
      const {page} = await openPlayground(hash);
      const name = hash.match(/\w+/)[0];
      assert.match(
        await page.textContent('#link-fault:visible'),
        new RegExp(`its part .${name}. is unknown`),
      );
    }
    for (const [hash, words] of [
      ['#time=3', /its part .time. is unknown/],
      ['#t=soon', /its t is not a number/],
      ['#run=7', /a run that is not in this page/],
    ]) {
      const {page, complaints} = await openReplay(hash);
      assert.match(await page.textContent('#link-fault:visible'), words);
      await page.evaluate(() => (location.hash = '#t=2'));
      await page.waitForSelector('#link-fault', {state: 'hidden'});
      assert.deepEqual(complaints, []);
    }
    assert.ok(await (await openReplay('#t=1')).page.isHidden('#link-fault'));
  });

  test('an address that says nonsense opens the first world', async () => {
    for (const hash of [
      '#world=moon&seed=x&planner=me&noise=a_b&rules=9&own=!!',
      '#own=eJyLjgUAARUAuQ',
      '#noise=9_9_9_9_9',
    ]) {
      const {page, complaints} = await openPlayground(hash);
      assert.equal(await play(page, 'play.state.kind'), 'u-trap');
      assert.match(await page.textContent('#link-fault:visible'), /^This link could not be read: its /);
      assert.deepEqual(complaints, []);
    }
  });

  const packed = (text) => deflateSync(Buffer.from(text), {level: 9}).toString('base64url');
  const head = '[1,600,0,0,4,0,0.1,0,0,0,0';
  for (const [name, own, words] of [
    ['64 MB in 65 kB', packed('0,'.repeat(32 << 20)), /too large for this page/],
    ['300 kB', 'A'.repeat(300_000), /too large for this page/],
    ['4,000 movers', packed(`${head},4000${',9,0,0.1,0.1,2,9,0,9,1'.repeat(4000)},0,0,0,0,0]`), /too large/],
    ['a goal at 1e9 m', packed('[1,600,0,0,1e9,0,0.1,0,0,0,0,0,0,0,0,0,0]'), /its world is not valid/],
    ['a list cut short', packed('[1,600,0]'), /damaged/],
    ['something else', packed('{"a":[1]}'), /damaged/],
  ]) {
    test(`a link with ${name} is not read, and the page says so`, async () => {
      const {page, complaints} = await openPlayground(`#own=${own}`);
      assert.match(await page.textContent('#link-fault:visible'), words);
      assert.equal(await play(page, 'play.state.own'), null);
      await page.evaluate(() => (location.hash = '#world=maze&seed=2&planner=skirt'));
      await page.waitForFunction(() => window.whisker.play.state.kind === 'maze');
      assert.ok(await page.isHidden('#link-fault'));
      await page.evaluate((bad) => (location.hash = `#own=${bad}`), own);
      await page.waitForSelector('#link-fault:visible');
      assert.equal(await play(page, 'play.state.kind'), 'maze');
      assert.deepEqual(complaints, []);
    });
  }

  test('a link that is entered is followed, though the page is about to write its own', async () => {
    const {page} = await openPlayground('#world=discs&seed=2&planner=skirt');
    await page.waitForTimeout(600);
    await page.evaluate(() => {
      const {play} = window.whisker;
      location.hash = '#world=maze&seed=2&planner=skirt';
      play.restore({...play.state, seed: 3});
    });
    await page.waitForFunction(() => window.whisker.play.state.kind === 'maze');
  });

  test('the copied link says what is there now, whatever the address says', async () => {
    const {page} = await openPlayground('#world=discs&seed=3&planner=skirt');
    await page.evaluate(() => {
      history.replaceState = () => {};
      Object.defineProperty(navigator, 'clipboard', {
        value: {writeText: async (text) => (window.copied = text)},
      });
    });
    await page.click('#next-seed');
    await page.click('#copy');
    await page.waitForFunction(() => window.copied);
    assert.match(await page.evaluate(() => window.copied), /#world=discs&seed=4&planner=skirt$/);
  });
});
