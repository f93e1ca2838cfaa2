// The playground's module without its page: the same drives as the native program's, in every class of worlds.
import assert from 'node:assert/strict';
import {readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {KINDS, nativeHashes} from './native.mjs';
import {randomSituation} from './random_scenarios.mjs';
import {Folder, ROOT, whisker} from './scenarios.mjs';
import * as sources from './sources.mjs';

const MODULE = process.env.PLAYGROUND_MODULE ?? join(ROOT, 'build/playground/host/lab/play/whisker.wasm');
const REFERENCE_NOISE = [0.01, 0.02, 0.01, 0.0001, 0.3];

describe('the core in the playground', () => {
  const folder = new Folder();
  let core;
  let scenarioToml;
  before(async () => {
    const {Core} = await sources.core();
    core = await Core.load(readFileSync(MODULE));
    ({scenarioToml} = await sources.toml());
  });
  after(() => folder.remove());

  const native = (file, planner) => JSON.parse(whisker('run', file, '--planner', planner, '--json'));
  const drive = (situation, planner) => {
    core.begin(0, planner, situation);
    core.advance(0, 1e9);
    return core.result(0);
  };

  test('imports nothing and knows every class of worlds', async () => {
    assert.deepEqual(WebAssembly.Module.imports(await WebAssembly.compile(readFileSync(MODULE))), []);
    assert.deepEqual(core.words.kinds, KINDS);
  });

  for (const kind of KINDS) {
    test(`${kind}: the native hash, of the native world and of the file that the page writes`, () => {
      const world = folder.at('world.toml');
      whisker('world', kind, '--seed', 5, '--out', world);
      const quiet = core.generate(kind, 5, false);
      const here = drive(quiet, 'skirt');
      const there = native(world, 'skirt');
      assert.equal(here.hash, there.hash);
      assert.equal(here.outcome, there.outcome);
      assert.equal(here.ticks, there.ticks);

      const led = native(world, 'map');
      assert.equal(drive(quiet, 'map').hash, led.hash);
      assert.notEqual(led.hash, there.hash);

      // The thesis's planner with noise, cut short: it may go on for half an hour.
      const noisy = {...quiet, noise: REFERENCE_NOISE, seed: 9, timeLimit: 60};
      const own = folder.at('own.toml');
      writeFileSync(own, scenarioToml(`a "${kind}"`, noisy));
      assert.equal(drive(noisy, 'thesis').hash, native(own, 'thesis').hash);
    });
  }

  test('a noisy world of the native generator is the quiet one with noise', () => {
    const world = folder.at('noisy.toml');
    whisker('world', 'maze', '--noise', '--seed', 2, '--out', world);
    const here = drive({...core.generate('maze', 2, false), noise: REFERENCE_NOISE}, 'skirt');
    assert.equal(here.hash, native(world, 'skirt').hash);
  });

  test('movers, walls and bounds that were drawn by hand', () => {
    const situation = {
      seed: 3,
      timeLimit: 100,
      noise: [0.02, 0.1, 0.02, 0.001, 0.5],
      world: {
        start: [0.1, -0.2], goal: [3.3, 0.7], tolerance: 0.12, bounds: [-1, -1.5, 4.5, 2],
        discs: [[1.2, 0.3, 0.2]], polygons: [[[2, -0.5], [2.1, -0.5], [2.05, 0.4]]],
        walls: [[[1.5, -1], [1.7, -0.3], [1.9, -0.9]]],
        movers: [{center: [2.6, 0.5], radius: 0.1, speed: 0.1, path: [[2.6, -0.5], [2.6, 1.5]]}],
      },
    }; // prettier-ignore
    const file = folder.at('hand.toml');
    writeFileSync(file, scenarioToml('by hand', situation));
    for (const planner of ['skirt', 'thesis', 'map']) {
      assert.equal(drive(situation, planner).hash, native(file, planner).hash, planner);
    }
  });

  test('what it drives the native program drives alike, and what it refuses that refuses', () => {
    const planners = ['skirt', 'thesis', 'map'];
    const verdicts = {good: 0, none: 0, touches: 0};
    const count = process.env.WHISKER_LONG ? 150 : 50;
    for (let seed = 1; seed <= count; ++seed) {
      const situation = randomSituation(seed);
      const judged = core.judge(situation);
      ++verdicts[judged];
      const file = folder.at('random.toml');
      writeFileSync(file, scenarioToml(`random ${seed}`, situation));
      const planner = planners[seed % 3];
      if (judged === 'good') {
        assert.equal(drive(situation, planner).hash, native(file, planner).hash, `seed ${seed}`);
      } else {
        assert.throws(
          () => whisker('run', file),
          ({status}) => status === 2,
          `seed ${seed}`,
        );
      }
    }
    assert.ok(verdicts.good > count / 5 && verdicts.none > count / 5, JSON.stringify(verdicts));
  });

  test('more things or points than the page takes are none, and a native scenario may have them', () => {
    const good = core.generate('u-trap', 1, false);
    const [x, y] = good.world.start;
    const judge = (world) => core.judge({...good, world: {...good.world, polygons: [], ...world}});
    const discs = (n) => Array.from({length: n}, () => [x + 5, y, 0.1]);
    assert.equal(judge({discs: discs(1000)}), 'good');
    assert.equal(judge({discs: discs(1001)}), 'none');
    const walls = [[[x + 5, y], [x + 6, y]]]; // prettier-ignore
    assert.equal(judge({discs: discs(1000), walls}), 'none');
    const long = (n) => [Array.from({length: n}, (_, i) => [x + 5 + i / 100, y])];
    assert.equal(judge({walls: long(4096)}), 'good');
    assert.equal(judge({walls: [...long(4095), ...walls]}), 'none');
    const file = folder.at('large.toml');
    writeFileSync(
      file,
      scenarioToml('large', {...good, timeLimit: 1, world: {...good.world, discs: discs(1001)}}),
    );
    assert.equal(typeof native(file, 'skirt').hash, 'string');
  });

  test('the hashes on record are what the native program gives', () => {
    const recorded = JSON.parse(readFileSync(join(ROOT, 'host/lab/web/src/playground/native.json'), 'utf8'));
    const now = nativeHashes([1], ['skirt', 'map']);
    assert.equal(Object.keys(now).length, 2 * KINDS.length);
    for (const [name, hash] of Object.entries(now)) assert.equal(recorded[name], hash, name);
  });

  test('without an edit its table is the committed file, to the byte', async () => {
    const {tableHeader} = await sources.header();
    const committed = readFileSync(join(ROOT, 'firmware/fuzzy/response_table.hpp'), 'utf8');
    assert.equal(tableHeader(core.table(), null), committed);
  });

  test('judges edits of the rules, and takes them back', () => {
    const rules = core.rules();
    assert.equal(core.setRules(rules), 0);
    const edited = (i, value) => core.setRules(rules.map((raw, k) => (k === i ? value : raw)));
    // D very small, R: right very near. Left is right, and right is wrong.
    assert.equal(edited(0, -rules[0]) & 0b111, 0b101);
    assert.ok(core.atFault(0, 0) && core.atFault(0, 4) && !core.atFault(3, 3));
    // The middle column turns: not mirrored.
    assert.equal(edited(2, rules[0]), 1);
    // A longer step on one side, nearer than the one beyond it.
    assert.equal(edited(25, rules[49]), 0b10010);
    // Less turn near than beyond.
    assert.equal(edited(0, 0) & 8, 8);
    assert.equal(core.setRules(rules), 0);
  });

  test('other rules give another drive, the old ones the old drive', () => {
    const situation = core.generate('discs', 3, false);
    const rules = core.rules();
    const before = drive(situation, 'skirt').hash;
    core.setRules(rules.map((raw, i) => (i < 25 ? -raw : raw)));
    assert.notEqual(drive(situation, 'skirt').hash, before);
    core.setRules(rules);
    assert.equal(drive(situation, 'skirt').hash, before);
  });

  test('the map has a window around the robot, and a plan that begins beside it', () => {
    const situation = core.generate('rooms', 4, false);
    core.begin(0, 'map', situation);
    core.advance(0, 3000);
    const record = new Map();
    core.record(0, record);
    const at = (name) => record.get(name)[0];
    const [columns, rows, cell, left, bottom, ...rest] = core.map(0);
    assert.deepEqual([columns, rows, cell], [64, 56, 0.1]);
    const states = rest.slice(0, columns * rows);
    assert.deepEqual([...new Set(states)].sort(), [0, 1, 2, 3]);
    const body = [Math.floor(at('est_x_m') / cell) - left, Math.floor(at('est_y_m') / cell) - bottom];
    assert.equal(states[body[0] + columns * body[1]], 1, 'the robot does not stand on free ground');
    const way = rest.slice(columns * rows);
    assert.ok(way.length > 10);
    assert.ok(Math.abs(way[0] - body[0]) <= 2 && Math.abs(way[1] - body[1]) <= 2);
    assert.ok(['goal', 'place'].includes(core.words.guides[at('guide')]));
    core.begin(0, 'skirt', situation);
    assert.equal(core.map(0).length, 0);
  });

  test('a goal that moves on is driven to', () => {
    const situation = core.generate('u-trap', 2, false);
    const first = drive(situation, 'skirt');
    assert.equal(first.outcome, 'reached');
    const [x, y] = situation.world.start;
    core.change(0, {...situation, world: {...situation.world, goal: [x, y]}});
    assert.equal(core.result(0).outcome, null);
    core.advance(0, 1e9);
    const second = core.result(0);
    assert.equal(second.outcome, 'reached');
    assert.ok(second.distance < 0.1);
    assert.ok(second.ticks > first.ticks);
  });

  test('an unreachable goal is looked for again once its fence is gone', () => {
    const situation = core.generate('enclosed', 3, false);
    assert.equal(drive(situation, 'skirt').outcome, 'unreachable');
    const open = {...situation.world, discs: [], polygons: [], walls: []};
    core.change(0, {...situation, world: open});
    core.advance(0, 1e9);
    assert.equal(core.result(0).outcome, 'reached');
  });

  test('nonsense is no world', () => {
    const good = core.generate('u-trap', 1, false);
    assert.equal(core.judge(good), 'good');
    const bad = (change) => core.judge({...good, world: {...good.world, ...change}});
    assert.equal(bad({discs: [[0, 0, -1]]}), 'none');
    assert.equal(bad({goal: [NaN, 0]}), 'none');
    assert.equal(bad({goal: [1e9, 0]}), 'none');
    assert.equal(bad({polygons: [[[0, 0]]]}), 'none');
    assert.equal(bad({discs: [[...good.world.start, 0.2]]}), 'touches');
    assert.equal(core.judge({...good, noise: [2, 2, 0, 0, 0]}), 'none');
  });
});
