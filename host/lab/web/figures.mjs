// Writes the pictures of docs/pages.md and docs/guard.md. usage: npm run figures
// The playground's page must have been built: scripts/playground --build-only
import {execFileSync} from 'node:child_process';
import {statSync, writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {drawn, launch, openPage, PHONE} from '../../../tests/web/browser.mjs';
import {Folder, whisker} from '../../../tests/web/scenarios.mjs';
import {RECORD, sourcesHash} from './sources_hash.mjs';

const PLAYGROUND = new URL('../../../out/playground/index.html', import.meta.url).href;
const FIGURES = [
  {name: 'replay', hash: '#t=31', viewport: {width: 1440, height: 900}, colorScheme: 'light'},
  {
    name: 'replay-map',
    file: 'map.html',
    hash: '#t=40',
    viewport: {width: 1440, height: 900},
    colorScheme: 'light',
  },
  {
    name: 'guard',
    file: 'guard.html',
    hash: '#t=31.4',
    viewport: {width: 1440, height: 900},
    colorScheme: 'light',
  },
  {name: 'replay-phone', hash: '#t=12', viewport: PHONE, colorScheme: 'dark', touch: true},
  {
    name: 'playground',
    url: PLAYGROUND,
    seconds: 16,
    viewport: {width: 1440, height: 900},
    colorScheme: 'light',
  },
  {
    name: 'playground-drive',
    url: `${PLAYGROUND}#world=rooms&seed=3&planner=you`,
    seconds: 9.8,
    asks: [0.8, -0.2],
    viewport: PHONE,
    colorScheme: 'light',
    touch: true,
  },
  {
    name: 'playground-phone',
    url: `${PLAYGROUND}#world=discs&seed=3&planner=skirt`,
    seconds: 32,
    viewport: PHONE,
    colorScheme: 'dark',
    touch: true,
  },
];

const folder = new Folder();
const browser = await launch();
try {
  folder.drive('discs', ['discs', '--noise', '--seed', 1]);
  folder.drive('map', ['rooms', '--seed', 4], '--planner', 'map');
  whisker('guard', folder.at('discs.toml'), '--operator', 'sloppy', '--html', folder.at('guard.html'));
  for (const {name, url, file = 'discs.html', seconds, asks = [0, 0], ...options} of FIGURES) {
    const {page} = await openPage(browser, url ?? folder.url(file, options.hash), {
      reducedMotion: 'reduce',
      ...options,
    });
    if (seconds) {
      await page.evaluate(
        ([ticks, ...stick]) => {
          const {play, driver} = window.whisker;
          driver.ask(...stick);
          for (const run of play.runs) {
            run.advance(ticks);
            run.refresh();
          }
          play.select(null);
        },
        [100 * seconds, ...asks],
      );
    }
    await drawn(page);
    const path = fileURLToPath(new URL(`../../../docs/figures/${name}.png`, import.meta.url));
    await page.screenshot({path});
    execFileSync('pngquant', ['--force', '--output', path, '256', path]);
    console.log(`${path}: ${statSync(path).size} bytes`);
  }
  writeFileSync(RECORD, `${sourcesHash()}\n`);
} finally {
  await browser.close();
  folder.remove();
}
