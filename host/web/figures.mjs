// Writes the pictures of docs/replay.md. usage: npm run figures
import {execFileSync} from 'node:child_process';
import {statSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import {drawn, launch, openPage, PHONE} from '../../tests/web/browser.mjs';
import {Folder} from '../../tests/web/scenarios.mjs';

const FIGURES = [
  {name: 'replay', hash: '#t=31', viewport: {width: 1440, height: 900}, colorScheme: 'light'},
  {name: 'replay-phone', hash: '#t=12', viewport: PHONE, colorScheme: 'dark', touch: true},
];

const folder = new Folder();
const browser = await launch();
try {
  folder.drive('discs', ['discs', '--noise', '--seed', 1]);
  for (const {name, hash, ...options} of FIGURES) {
    const {page} = await openPage(browser, folder.url('discs.html', hash), options);
    await drawn(page);
    const path = fileURLToPath(new URL(`../../docs/figures/${name}.png`, import.meta.url));
    await page.screenshot({path});
    execFileSync('pngquant', ['--force', '--output', path, '256', path]);
    console.log(`${path}: ${statSync(path).size} bytes`);
  }
} finally {
  await browser.close();
  folder.remove();
}
