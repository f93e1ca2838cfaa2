// Measures the playground's page in headless Chromium. usage: npm run measure-playground
// The page must have been built: scripts/playground --build-only
import {readFileSync, statSync} from 'node:fs';
import {gzipSync} from 'node:zlib';
import {DESKTOP, launch, openPage} from '../../tests/web/browser.mjs';

const PAGE = new URL('../../out/playground/index.html', import.meta.url);
const MODULE = new URL('../../build/playground/host/play/whisker.wasm', import.meta.url);
const LOADS = 7;

const at = (values, p) => [...values].sort((a, b) => a - b)[Math.max(0, Math.ceil(p * values.length) - 1)];

/** Milliseconds from asking for the file to the first picture. */
async function loadTime(browser) {
  const context = await browser.newContext({viewport: DESKTOP, reducedMotion: 'reduce'});
  const page = await context.newPage();
  await page.goto(PAGE.href);
  await page.waitForFunction(() => document.body.dataset.view);
  const time = await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(performance.now())))),
  );
  await context.close();
  return time;
}

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
console.log(`module              ${wasm.length} bytes, ${gzipSync(wasm, {level: 9}).length} packed`);
console.log(`page                ${statSync(PAGE).size} bytes`);
const browser = await launch();
try {
  const loads = [];
  for (let i = 0; i < LOADS; ++i) loads.push(await loadTime(browser));
  console.log(`load                ${at(loads, 0.5).toFixed(0)} ms, median of ${LOADS}`);
  for (const [who, speed] of [
    ['skirt', 1],
    ['both', 1],
    ['both', 16],
  ]) {
    const {page} = await openPage(browser, `${PAGE.href}#world=rooms&seed=3&planner=${who}`, {
      reducedMotion: 'reduce',
    });
    const {gaps, times} = await frames(page, speed, 4);
    const rate = 1000 / (gaps.reduce((sum, gap) => sum + gap, 0) / gaps.length);
    console.log(
      `${`${who} at ${speed} x`.padEnd(20)}${rate.toFixed(0)} frames a second, 95 % within ${at(gaps, 0.95).toFixed(1)} ms, ${times.toFixed(1)} times real time`,
    );
    await page.context().close();
  }
} finally {
  await browser.close();
}
