// The playground with a table that `whisker rules table` wrote.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {describe, test} from 'node:test';
import {drawn, pictureOf} from './browser.mjs';
import {everybodyCanRead, inBrowser} from './in_browser.mjs';
import {ROOT, whisker} from './scenarios.mjs';
import * as sources from './sources.mjs';

const PAGE = process.env.PLAYGROUND ?? join(ROOT, 'out/playground/index.html');
const MODULE = process.env.PLAYGROUND_MODULE ?? join(ROOT, 'build/playground/host/lab/play/whisker.wasm');
const THESIS = join(ROOT, 'host/rules/examples/thesis.toml');

describe('an opened table', () => {
  const {folder, openPage} = inBrowser(() => {
    whisker('rules', 'table', THESIS, '--out', fits);
    writeFileSync(oneSided, readFileSync(THESIS, 'utf8').replace('["TLVB", 1.5]', '["TLVB", 1.9]'));
    const table = JSON.parse(whisker('rules', 'table', oneSided));
    writeFileSync(other, JSON.stringify({...table, name: '<b>one\n#error sided'}));
  });
  const fits = folder.at('thesis.json');
  // Its left turns are stronger than its right turns.
  const oneSided = folder.at('one-sided.toml');
  const other = folder.at('one-sided.json');

  const open = (hash, options = {}) =>
    openPage(`file://${PAGE}${hash}`, {reducedMotion: 'reduce', ...options});
  const play = (page, look) => page.evaluate(`(({play}) => (${look}))(window.whisker)`);
  const hashOf = (page) => play(page, 'play.runs[0].result.hash');
  /** By keyboard alone. */
  const choose = async (page, file) => {
    const [chooser] = await Promise.all([
      page.waitForEvent('filechooser'),
      page.locator('#table-open').press('Enter'),
    ]);
    await chooser.setFiles(file);
  };
  const opened = async (page, file) => {
    await choose(page, file);
    await page.locator('#table-opened').filter({hasText: /\w/}).waitFor();
    await drawn(page);
  };
  const toTheEnd = async (page) => {
    await page.click('#finish');
    await page.waitForFunction(() => window.whisker.play.over);
    await drawn(page);
  };
  const download = async (page, button) => {
    const [file] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
    const path = folder.at(file.suggestedFilename());
    await file.saveAs(path);
    return path;
  };
  const native = (file, planner, rules) =>
    JSON.parse(whisker('run', file, '--planner', planner, '--rules', rules, '--json')).hash;

  for (const planner of ['skirt', 'map', 'thesis']) {
    for (const rules of [THESIS, oneSided]) {
      test(`${planner}: the hash is that of --rules ${rules.replace(/.*\//, '')}`, async () => {
        const {page, complaints} = await open(`#world=discs&seed=3&planner=${planner}`);
        await opened(page, rules === THESIS ? fits : other);
        await toTheEnd(page);
        const file = await download(page, '#save-scenario');
        assert.equal(await hashOf(page), native(file, planner, rules));
        assert.match(await page.textContent('#hashes'), /save the scenario and run it with --rules/);
        assert.match(await page.locator('pre.command:visible').textContent(), /--rules RULES\.fis --json/);
        // Again, the robot starts with it.
        const first = await hashOf(page);
        await page.click('#again');
        await toTheEnd(page);
        assert.equal(await hashOf(page), first);
        assert.deepEqual(complaints, []);
      });
    }
  }

  test('takes the place of the 25 rules until Reset', async () => {
    const {page, complaints} = await open('#world=discs&seed=3&planner=thesis');
    await toTheEnd(page);
    const [hash, picture] = [await hashOf(page), (await pictureOf(page, 'heat-turn')).sum];
    assert.ok((await page.locator('#rules li').count()) > 0);
    await page.locator('[data-rule="14"]').click();
    await page.waitForFunction(() => location.hash.includes('rules='));
    await opened(page, other);
    const {hash: name, symmetric} = JSON.parse(readFileSync(other, 'utf8'));
    assert.equal(symmetric, false);
    assert.equal(
      await page.textContent('#table-opened'),
      `<b>one #error sided, hash ${name}: not symmetric: in a mirrored world the robot would not drive the mirrored path.`,
    );
    for (const id of ['rule-squares', 'rules-mirror', 'edit-turn', 'rules-good', 'rule-warnings']) {
      assert.ok(await page.isHidden(`#${id}`), id);
    }
    assert.match(await page.textContent('#table-source'), /33 × 57 nodes, opened from a file/);
    assert.equal(await page.locator('#rules li').count(), 0);
    assert.notEqual((await pictureOf(page, 'heat-turn')).sum, picture);
    assert.match(await page.textContent('#hashes'), /changed during the run/);
    await page.waitForFunction(() => !location.hash.includes('rules='));
    await page.locator('text=but not the table that you opened').waitFor();
    const header = readFileSync(await download(page, '#save-table'), 'utf8');
    assert.ok(
      header.split('\n')[0].endsWith(`Opened in the playground: <b>one #error sided, hash ${name}.`),
      header.slice(0, 300),
    );

    await page.click('#rules-reset');
    assert.equal(await page.textContent('#table-opened'), '');
    assert.equal(await page.locator('.rule:visible').count(), 25);
    assert.equal(await page.locator('.rule.own').count(), 0);
    assert.match(await page.textContent('#table-source'), /made from the 25 rules/);
    await page.click('#again');
    await toTheEnd(page);
    assert.equal(await hashOf(page), hash);
    assert.equal((await pictureOf(page, 'heat-turn')).sum, picture);
    assert.match(await page.textContent('#hashes'), /equals the native run/);
    assert.deepEqual(complaints, []);
  });

  test('of the default rules is symmetric, and a link with rules closes it', async () => {
    const {page} = await open('#world=u-trap&seed=7&planner=skirt');
    const picture = await page.evaluate('[...window.whisker.core.samples()]');
    await opened(page, fits);
    assert.match(await page.textContent('#table-opened'), /^thesis, hash [0-9a-f]{8}: symmetric\.$/);
    assert.deepEqual(await page.evaluate('[...window.whisker.core.samples()]'), picture);
    await page.evaluate((code) => {
      location.hash = `#world=u-trap&seed=7&planner=skirt&rules=${code}`;
    }, '4'.repeat(50));
    await page.locator('.rule').first().waitFor();
    assert.equal(await page.textContent('#table-opened'), '');
  });

  test('a wrong file is one line, and changes nothing', async () => {
    const {page, complaints} = await open('#world=discs&seed=3&planner=skirt');
    const text = readFileSync(fits, 'utf8');
    const file = JSON.parse(text);
    const having = (change) => JSON.stringify({...file, ...change});
    const node = (x) => having({nodes: file.nodes.map((raw, i) => (i === 7 ? x : raw))});
    const state = () =>
      page.evaluate(() => [
        [...window.whisker.core.table().nodes],
        document.getElementById('table-opened').textContent,
        document.getElementById('rule-squares').hidden,
      ]);
    const refused = async (content, says) => {
      const path = folder.at('wrong.json');
      writeFileSync(path, content);
      const before = await state();
      await choose(page, path);
      await page.locator('#table-fault').filter({hasText: says}).waitFor();
      const line = await page.textContent('#table-fault');
      assert.match(line, /^wrong\.json could not be opened: [^\n]+\.$/);
      assert.deepEqual(await state(), before, line);
    };
    const all = async () => {
      await refused(text.slice(0, -20), 'not JSON, or not all of it');
      await refused('[1, 2]', 'not from whisker rules table');
      await refused('null', 'not from whisker rules table');
      await refused(having({whisker_table: 2}), 'reads format 1 only');
      await refused(having({name: '\n'}), 'has no name');
      await refused(having({hash: 'b02921c'}), 'its hash is not valid');
      await refused(having({rows: 34}), 'has 33 × 57 nodes');
      await refused(having({nodes: file.nodes.slice(2)}), 'its nodes are not 3762 whole numbers');
      for (const x of [-32768, 32768, 0.5]) await refused(node(x), 'whole numbers from -32767 to 32767');
      await refused(node('1'), 'its nodes are not numbers');
      await refused(node(file.nodes[7] + 1), 'its nodes do not have its hash');
      await refused(' '.repeat(500_001), 'too large');
    };
    await all();
    await opened(page, other);
    assert.ok(await page.isHidden('#table-fault'));
    await all();
    await page.click('#rules-reset');
    assert.ok(await page.isHidden('#table-fault'));
    assert.deepEqual(complaints, []);
  });

  test('is that of the assist, and the drive that is saved is natively the same', async () => {
    const {page, complaints} = await open('#world=discs&seed=3&planner=you');
    await opened(page, other);
    for (const [ahead, left] of [
      [1, 0],
      [1, 0.3],
      [0.5, -0.4],
    ]) {
      await page.evaluate(
        ([x, y]) => {
          const {play, driver} = window.whisker;
          driver.ask(x, y);
          for (let i = 0; i < 40; ++i) play.runs[0].advance(10);
          driver.ask(0, 0);
          play.runs[0].refresh();
          play.select(null);
        },
        [ahead, left],
      );
    }
    await drawn(page);
    const scenario = await download(page, '#save-scenario');
    const commands = await download(page, '#save-drive');
    const words = (await page.textContent('#command'))
      .replace('SCENARIO.toml', scenario)
      .replace('DRIVE.csv', commands)
      .replace('RULES.fis', oneSided)
      .replace('drive.html', folder.at('drive.html'))
      .split(' ');
    assert.equal(words.shift(), 'whisker');
    assert.ok(words.includes(oneSided));
    const drive = (...args) => JSON.parse(whisker(...args, '--json')).hash;
    assert.equal(drive(...words), await hashOf(page));
    const at = words.indexOf('--rules');
    assert.notEqual(drive(...words.slice(0, at), ...words.slice(at + 2)), await hashOf(page));
    assert.deepEqual(complaints, []);
  });

  everybodyCanRead(async (options) => {
    const shown = await open('#world=discs&seed=3&planner=skirt', options);
    await opened(shown.page, other);
    await choose(shown.page, PAGE);
    await shown.page.locator('#table-fault').filter({hasText: 'index.html'}).waitFor();
    return shown;
  });
});

test('the module takes the table of the default rules, to the byte, and refuses others', async () => {
  const {Core} = await sources.core();
  const core = await Core.load(readFileSync(MODULE));
  const {hash, nodes, rows, columns} = JSON.parse(whisker('rules', 'table', THESIS));
  const number = parseInt(hash, 16);
  assert.deepEqual([...core.table().nodes], nodes);
  assert.deepEqual([core.table().rows, core.table().columns], [rows, columns]);
  assert.equal(core.setTable(nodes, number), 'done');
  assert.equal(core.setTable(nodes, number ^ 1), 'damaged');
  assert.equal(core.setTable([], number), 'none');
  assert.deepEqual([...core.table().nodes], nodes);
});
