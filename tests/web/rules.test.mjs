// The page of a rule base.
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {accessibilityFaults, PHONE} from './browser.mjs';
import {inBrowser} from './in_browser.mjs';
import {ROOT, whisker} from './scenarios.mjs';

const NAMES = ['thesis.toml', 'tip.fis', 'pendulum.fll', 'fan.fcl', 'follower.fis'];

/** Ends, middle and others: shares of the range of an input. */
const SHARES = [0, 0.13, 0.5, 0.71, 1];

describe('the page of a rule base', () => {
  const {folder, openPage} = inBrowser(() => {
    for (const name of NAMES) {
      whisker('rules', 'show', `${ROOT}/host/rules/examples/${name}`, '--html', folder.at(`${name}.html`));
    }
  });

  for (const name of NAMES) {
    test(`${name}: the table answers within its bound`, async () => {
      const {page, complaints} = await openPage(folder.url(`${name}.html`));
      const sliders = page.locator('#inputs input');
      const count = await sliders.count();
      const {outputs} = JSON.parse(await page.locator('#data').textContent());
      for (const a of SHARES) {
        for (const b of count > 1 ? SHARES : [0]) {
          const values = await page.evaluate(
            (shares) =>
              [...document.querySelectorAll('#inputs input')].map((slider, i) => {
                const [low, high] = [Number(slider.min), Number(slider.max)];
                slider.value = Math.round(low + (high - low) * shares[i]);
                slider.dispatchEvent(new Event('input'));
                const {origin, per_unit: perUnit} = JSON.parse(document.getElementById('data').textContent)
                  .inputs[i];
                return `${slider.name}=${origin + Number(slider.value) / perUnit}`;
              }),
            [a, b],
          );
          const exact = whisker('rules', 'evaluate', `${ROOT}/host/rules/examples/${name}`, ...values);
          const shown = await page
            .locator('#answers dd')
            .evaluateAll((all) => all.map((dd) => Number(dd.firstChild.textContent)));
          exact
            .trim()
            .split('\n')
            .forEach((line, o) => {
              const answer = Number(line.match(/ = (\S+)/)[1]);
              const most = outputs[o].error + 1e-5 * Math.max(1, Math.abs(answer));
              assert.ok(Math.abs(answer - shown[o]) <= most, `${values}: ${shown[o]}, not ${line}`);
            });
        }
      }
      assert.deepEqual(complaints, []);
    });
  }

  test('is accessible, in the dark and on a phone, too', async () => {
    for (const options of [{}, {colorScheme: 'dark'}, {viewport: PHONE}]) {
      const {page} = await openPage(folder.url('thesis.toml.html'), options);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `${wide} px too wide`);
      const {width} = await page.locator('#inputs input').first().boundingBox();
      assert.ok(width >= 150, `a slider of ${width} px`);
      assert.deepEqual(await accessibilityFaults(page), []);
    }
  });
});
