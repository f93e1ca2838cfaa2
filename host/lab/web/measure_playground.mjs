// Measures the playground's page in headless Chromium. usage: npm run measure-playground
// The page must have been built: scripts/playground --build-only
import {readFileSync, statSync} from 'node:fs';
import {gzipSync} from 'node:zlib';
import {DESKTOP, launch, openPage} from '../../../tests/web/browser.mjs';
import {frameRate, print, printLoadTime} from './timing.mjs';

const PAGE = new URL('../../../out/playground/index.html', import.meta.url);
const MODULE = new URL('../../../build/playground/host/lab/play/whisker.wasm', import.meta.url);
const STILL = {reducedMotion: 'reduce'};

/** Gaps between frames while it drives, ms, and how many times real time it drove. */
function frames(page, speed, seconds) {
  return page.evaluate(
    async ([factor, length]) => {
      const {play} = window.whisker;
      play.begin();
      play.speed = factor;
      play.setPlaying(true);
      const gaps = [];
      const begin = performance.now();
      let last = begin;
      while (last - begin < 1000 * length && !play.over) {
        const now = await new Promise((frame) => requestAnimationFrame(frame));
        gaps.push(now - last);
        last = now;
      }
      play.setPlaying(false);
      return {gaps: gaps.slice(1), times: (1000 * play.time) / (last - begin)};
    },
    [speed, seconds],
  );
}

const wasm = readFileSync(MODULE);
print('module', `${wasm.length} bytes, ${gzipSync(wasm, {level: 9}).length} packed`);
print('page', `${statSync(PAGE).size} bytes`);
const browser = await launch();
try {
  await printLoadTime(browser, PAGE.href, {viewport: DESKTOP, ...STILL});
  for (const [who, speed] of [
    ['skirt', 1],
    ['both', 1],
    ['both', 16],
  ]) {
    const {page} = await openPage(browser, `${PAGE.href}#world=rooms&seed=3&planner=${who}`, STILL);
    const {gaps, times} = await frames(page, speed, 4);
    print(`${who} at ${speed} x`, `${frameRate(gaps)}, ${times.toFixed(1)} times real time`);
    await page.context().close();
  }
} finally {
  await browser.close();
}
