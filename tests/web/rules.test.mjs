// The page of a rule base.
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {ROOT, U_TRAP, whisker} from './scenarios.mjs';

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

  const styleOf = (page, selector, property) =>
    page
      .locator(selector)
      .first()
      .evaluate((node, name) => getComputedStyle(node)[name], property);

  test('has the looks of the other pages, light and dark', async () => {
    const {page, complaints} = await openPage(folder.url('thesis.toml.html'));
    assert.equal(await page.textContent('.name'), 'Whisker');
    const looks = async () => [
      await styleOf(page, 'body', 'backgroundColor'),
      await styleOf(page, '.picture .ground', 'fill'),
      await styleOf(page, '.picture text', 'fill'),
      await styleOf(page, '.picture .diverging [data-k]', 'fill'),
    ];
    assert.equal(await styleOf(page, '.picture .card', 'fill'), 'none');
    const light = await looks();
    await page.click('#theme');
    const dark = await looks();
    light.forEach((look, i) => assert.notEqual(dark[i], look));
    const system = await openPage(folder.url('thesis.toml.html'), {colorScheme: 'dark'});
    assert.equal(await styleOf(system.page, '.picture .ground', 'fill'), dark[1]);
    assert.deepEqual([...complaints, ...system.complaints], []);
  });

  test("draws the robot's table as the replay page does", async () => {
    folder.run('run', U_TRAP);
    for (const colorScheme of ['light', 'dark']) {
      const {page} = await openPage(folder.url('thesis.toml.html'), {colorScheme});
      const {page: replay} = await openPage(folder.url('run.html'), {colorScheme});
      for (const [scale, id] of [
        ['diverging', 'heat-turn'],
        ['sequential', 'heat-step'],
      ]) {
        for (const [right, up] of [
          [0.1, 0.1],
          [0.9, 0.1],
          [0.2, 0.5],
          [0.5, 0.9],
        ]) {
          const here = await page.locator(`.${scale}`).evaluate(
            (map, [x, y]) => {
              const box = map.querySelector('.frame').getBBox();
              const at = new DOMPoint(box.x + x * box.width, box.y + (1 - y) * box.height);
              const cell = [...map.querySelectorAll('[data-k]')].find((path) => path.isPointInFill(at));
              return getComputedStyle(cell).fill.match(/\d+/g).map(Number);
            },
            [right, up],
          );
          const there = await replay.evaluate(
            ([name, x, y]) => {
              const canvas = document.getElementById(name);
              const [width, height] = [canvas.clientWidth, canvas.clientHeight];
              const k = canvas.width / width;
              const at = [30 + x * (width - 38), 6 + (1 - y) * (height - 36)].map((p) => Math.round(p * k));
              return [...canvas.getContext('2d').getImageData(...at, 1, 1).data].slice(0, 3);
            },
            [id, right, up],
          );
          here.forEach((level, i) => {
            assert.ok(Math.abs(level - there[i]) < 24, `${scale} at ${right}, ${up}: ${here}, not ${there}`);
          });
        }
      }
    }
  });

  test('its address is the question', async () => {
    const {page, complaints} = await openPage(folder.url('thesis.toml.html', '#D=2.5&R=-4'));
    const shown = () => page.locator('#inputs output').allTextContents();
    assert.deepEqual(await shown(), ['2.5', '-4']);
    await page.focus('#inputs input');
    await page.keyboard.press('End');
    await page.waitForFunction(() => location.hash === '#D=10&R=-4');
    await page.evaluate(() => (location.hash = '#D=1'));
    await page.waitForFunction(() => document.querySelector('#inputs output').textContent === '1');
    assert.deepEqual(await shown(), ['1', '0']);
    assert.ok(await page.isHidden('#link-fault'));
    for (const [hash, words] of [
      ['#d=1', /its part .d. is unknown/],
      ['#D=11', /its D is not a number from 0 to 10/],
      ['#R=left', /its R is not a number from -8 to 8/],
    ]) {
      await page.evaluate((to) => (location.hash = to), hash);
      await page.waitForSelector('#link-fault:visible');
      assert.match(await page.textContent('#link-fault'), words);
    }
    assert.deepEqual(complaints, []);
  });

  everybodyCanRead(async (options) => {
    const opened = await openPage(folder.url('thesis.toml.html'), options);
    const {width} = await opened.page.locator('#inputs input').first().boundingBox();
    assert.ok(width >= 150, `a slider of ${width} px`);
    return opened;
  });
});
