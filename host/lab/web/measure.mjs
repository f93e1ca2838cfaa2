// Measures the page of a run of ten minutes at 100 Hz in headless Chromium. usage: npm run measure
import {readFileSync, statSync} from 'node:fs';
import {deflateSync, inflateSync} from 'node:zlib';
import {DESKTOP, drawn, launch, openPage} from '../../../tests/web/browser.mjs';
import {Folder} from '../../../tests/web/scenarios.mjs';
import {at, frameRate, print, printLoadTime} from './timing.mjs';

const SCRUBS = 200;

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

/** Bytes of a page, and how many fewer it would have without the columns of the map. */
function mapShare(path) {
  const page = readFileSync(path, 'utf8');
  const [{columns}] = JSON.parse(page.match(/id="data">(.*?)<\/script>/s)[1]).runs;
  const bytes = inflateSync(Buffer.from(page.match(/id="columns-0">(.*?)<\/script>/s)[1], 'base64'));
  const kept = [];
  let end = 0;
  for (const [name, , , count] of columns) {
    const begin = end;
    for (let i = 0; i < count; ++i) while (bytes[end++] >= 0x80);
    if (!name.startsWith('map_')) kept.push(bytes.subarray(begin, end));
  }
  const stored = (data) => (deflateSync(data, {level: 9}).length * 4) / 3;
  return [page.length, stored(bytes) - stored(Buffer.concat(kept))];
}

const folder = new Folder();
const browser = await launch();
try {
  const result = folder.tenMinutes('long');
  print('ticks', String(result.ticks));
  const megabytes = (name) => `${(statSync(folder.at(name)).size / 1e6).toFixed(2)} MB`;
  print('page', `${megabytes('long.html')}; its trace as CSV ${megabytes('long.csv')}`);
  const led = folder.drive('map', ['rooms', '--noise', '--seed', 4], '--planner', 'map');
  const [bytes, map] = mapShare(folder.at('map.html'));
  print(
    'with a map',
    `${(bytes / 1e3).toFixed(0)} kB for ${led.time_s} s, the map ${(map / 1e3).toFixed(1)} kB of them`,
  );
  await printLoadTime(browser, folder.url('long.html'), {viewport: DESKTOP});
  const {page} = await openPage(browser, folder.url('long.html'));
  await drawn(page);
  for (const speed of [1, 16]) {
    print(`playing at ${speed} x`, frameRate(await framesWhilePlaying(page, speed, 4)));
  }
  const times = await scrubs(page, SCRUBS);
  print(
    'scrubbing',
    `${at(times, 0.5).toFixed(1)} ms to the picture, 95 % within ${at(times, 0.95).toFixed(1)} ms`,
  );
} finally {
  await browser.close();
  folder.remove();
}
