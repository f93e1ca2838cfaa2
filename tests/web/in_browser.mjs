// The folder and the browser of the tests of a describe().
import {after, afterEach, before} from 'node:test';
import {closePages, launch, openPage} from './browser.mjs';
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
