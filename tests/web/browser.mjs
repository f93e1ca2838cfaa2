// A headless Chromium that keeps account of what a page complains about or asks the network for.
import {createRequire} from 'node:module';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {ROOT} from './scenarios.mjs';

// The packages are those of host/lab/web.
export const require = createRequire(join(ROOT, 'host/lab/web/package.json'));
const {chromium} = require('playwright-core');

export const DESKTOP = {width: 1440, height: 900};
export const PHONE = {width: 390, height: 844};

export function launch() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox'],
  });
}

/** A page that is open on `url` and has drawn itself; `complaints` grows with whatever is wrong. It may ask `server`. */
export async function openPage(
  browser,
  url,
  {
    viewport = DESKTOP,
    colorScheme = 'light',
    touch = false,
    reducedMotion = 'no-preference',
    server = null,
  } = {},
) {
  const context = await browser.newContext({
    viewport,
    colorScheme,
    hasTouch: touch,
    reducedMotion,
  });
  const page = await context.newPage();
  const complaints = [];
  page.on('console', (message) => {
    // That is what pictureOf does.
    if (message.text().includes('readback')) return;
    if (['error', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(error.stack));
  page.on('request', (request) => {
    if (server && request.url().startsWith(server)) return;
    if (!/^(file|data|blob):/.test(request.url())) complaints.push(`asked for ${request.url()}`);
  });
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.view);
  await drawn(page);
  return {page, complaints};
}

export async function closePages(browser) {
  for (const context of browser.contexts()) await context.close();
}

/** Two frames: what was asked for before is on the screen. */
export function drawn(page) {
  return page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

export function tickOf(page) {
  return page.evaluate(() => window.whisker.player.tick);
}

export function seek(page, tick) {
  return page.evaluate((to) => window.whisker.player.seek(to), tick).then(() => drawn(page));
}

/** What axe-core finds wrong, one line each. */
export async function accessibilityFaults(page) {
  await page.addScriptTag({
    content: readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8'),
  });
  const {violations} = await page.evaluate(() => window.axe.run());
  return violations.flatMap(({id, nodes}) =>
    nodes.map(({target, failureSummary}) => `${id}: ${target} ${failureSummary}`),
  );
}

/** How many colours a canvas shows, and a number that tells its pictures apart. */
export function pictureOf(page, id) {
  return page.evaluate((name) => {
    const canvas = document.getElementById(name);
    const pixels = new Uint32Array(
      canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer,
    );
    let sum = 0;
    for (const pixel of pixels) sum = (Math.imul(sum, 31) + pixel) | 0;
    return {colours: new Set(pixels).size, sum};
  }, id);
}
