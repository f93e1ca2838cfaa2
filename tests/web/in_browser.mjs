// The folder and the browser of the tests of a describe().
import assert from 'node:assert/strict';
import {after, afterEach, before, test} from 'node:test';
import {accessibilityFaults, closePages, launch, openPage, PHONE} from './browser.mjs';
import {Folder} from './scenarios.mjs';

/** Both go with the last test, a test's pages with the test; `prepare` comes before the first. */
export function inBrowser(prepare = () => {}) {
  const folder = new Folder();
  let browser;
  before(async () => {
    prepare();
    browser = await launch();
  });
  afterEach(() => closePages(browser));
  after(async () => {
    await browser?.close();
    folder.remove();
  });
  return {folder, openPage: (url, options) => openPage(browser, url, options)};
}

const LOOKS = {light: {}, dark: {colorScheme: 'dark'}, phone: {viewport: PHONE, touch: true}};

/** A test for each look. `open(options)` returns the page, ready to be read, and its complaints. */
export function everybodyCanRead(open) {
  for (const [look, options] of Object.entries(LOOKS)) {
    test(`${look}: fits, and axe finds no fault`, async () => {
      const {page, complaints} = await open(options);
      assert.deepEqual(await accessibilityFaults(page), []);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${wide} px too wide`);
      assert.deepEqual(complaints, []);
    });
  }
}
