// Measures the page of a run of ten minutes at 100 Hz in headless Chromium. usage: npm run measure
import {statSync} from 'node:fs';
import {DESKTOP, drawn, launch, openPage} from '../../tests/web/browser.mjs';
import {Folder} from '../../tests/web/scenarios.mjs';

const LOADS = 7;
const SCRUBS = 200;

const sorted = (values) => [...values].sort((a, b) => a - b);
const at = (values, p) => sorted(values)[Math.max(0, Math.ceil(p * values.length) - 1)];

/** Milliseconds from asking for the file to the first picture. */
async function loadTime(browser, url) {
  const context = await browser.newContext({viewport: DESKTOP});
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.view);
  const time = await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(performance.now())))),
  );
  await context.close();
  return time;
}

/** Gaps between frames while it plays, ms. */
function framesWhilePlaying(page, speed, seconds) {
  return page.evaluate(
    async ([factor, length]) => {
      const {player} = window.whisker;
      player.seek(20000);
      player.setSpeed(factor);
      player.play();
      const gaps = [];
      const begin = performance.now();
      for (let last = begin; last - begin < 1000 * length;) {
        const now = await new Promise((frame) => requestAnimationFrame(frame));
        gaps.push(now - last);
        last = now;
      }
      player.pause();
      return gaps.slice(1);
    },
    [speed, seconds],
  );
}

/** From asking for a tick anywhere in the run to its picture, ms. */
function scrubs(page, count) {
  return page.evaluate(async (n) => {
    const {player} = window.whisker;
    const times = [];
    for (let i = 0; i < n; ++i) {
      const begin = performance.now();
      player.seek((i * 40503) % player.end);
      await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
      times.push(performance.now() - begin);
    }
    return times;
  }, count);
}

const folder = new Folder();
const browser = await launch();
try {
  const result = folder.tenMinutes('long');
  const bytes = statSync(folder.at('long.html')).size;
  console.log(`ticks               ${result.ticks}`);
  console.log(
    `page                ${(bytes / 1e6).toFixed(2)} MB; its trace as CSV ${(statSync(folder.at('long.csv')).size / 1e6).toFixed(2)} MB`,
  );
  const loads = [];
  for (let i = 0; i < LOADS; ++i) loads.push(await loadTime(browser, folder.url('long.html')));
  console.log(`load                ${at(loads, 0.5).toFixed(0)} ms, median of ${LOADS}`);
  const {page} = await openPage(browser, folder.url('long.html'));
  await drawn(page);
  for (const speed of [1, 16]) {
    const gaps = await framesWhilePlaying(page, speed, 4);
    const rate = 1000 / (gaps.reduce((sum, gap) => sum + gap, 0) / gaps.length);
    console.log(
      `playing at ${`${speed} x`.padEnd(9)}${rate.toFixed(0)} frames a second, 95 % within ${at(gaps, 0.95).toFixed(1)} ms`,
    );
  }
  const times = await scrubs(page, SCRUBS);
  console.log(
    `scrubbing           ${at(times, 0.5).toFixed(1)} ms to the picture, 95 % within ${at(times, 0.95).toFixed(1)} ms`,
  );
} finally {
  await browser.close();
  folder.remove();
}
