// Modules of the page that need no browser.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import * as sources from './sources.mjs';

test('columns: values, differences and second differences', async () => {
  const {decodeColumns} = await sources.columns();
  // 0, -1, 1, -2; then 64 and 2^40.
  const far = [0x80, 0x80, 0x80, 0x80, 0x80, 0x40];
  const bytes = Uint8Array.from([0, 1, 2, 3, 0x80, 0x01, ...far, 2, 2, 2, 2, 0, 1]);
  const infos = [
    ['plain', 0, 1, 6],
    ['line', 1, 10, 3],
    ['curve', 2, 1, 3],
  ];
  const columns = decodeColumns(bytes, infos);
  assert.deepEqual([...columns.get('plain')], [0, -1, 1, -2, 64, 2 ** 40]);
  assert.deepEqual([...columns.get('line')], [0.1, 0.2, 0.3]);
  assert.deepEqual([...columns.get('curve')], [1, 2, 2]);
});

test('columns: too few and too many bytes are refused', async () => {
  const {decodeColumns} = await sources.columns();
  assert.throws(() => decodeColumns(Uint8Array.from([0x80]), [['x', 0, 1, 1]]), /ends within column x/);
  assert.throws(() => decodeColumns(Uint8Array.from([0, 0]), [['x', 0, 1, 1]]), /1 bytes behind/);
});

test('link: what is written is read back, and nonsense is nothing', async () => {
  const {placeOf, hashOf} = await sources.link();
  for (const place of [
    {run: null, time: null},
    {run: 3, time: null},
    {run: 0, time: 12.34},
    {run: null, time: 600},
  ]) {
    assert.deepEqual(placeOf(hashOf(place)), place);
  }
  assert.equal(hashOf({run: 2, time: 12.34}), '#run=2&t=12.34');
  assert.deepEqual(placeOf('#t=-1&run=x'), {run: null, time: null});
  assert.deepEqual(placeOf('#t='), {run: null, time: null});
});

test('histogram: round steps and quantiles', async () => {
  const {roundStep, quantile} = await sources.histogram();
  assert.equal(roundStep(24, 24), 1);
  assert.equal(roundStep(25, 24), 2);
  assert.equal(roundStep(0.9, 6), 0.2);
  assert.equal(quantile([1, 2, 3, 4], 0.5), 2);
  assert.equal(quantile([1, 2, 3, 4], 0.95), 4);
  assert.equal(quantile([7], 0.05), 7);
});

test('words: what moves does not stand yet', async () => {
  const {sentence} = await sources.words();
  assert.equal(sentence('looking', 'none', '', 0), 'Stands and takes a static scan.');
  assert.equal(sentence('looking', 'none', '', 0.16), 'Comes to a stand and takes a static scan.');
  assert.equal(sentence('stopped', 'fault', '', 0.16), 'Stops for safety: something failed.');
  assert.equal(sentence('stopped', 'fault', '', 0.004), 'Stopped for safety: something failed.');
});

test('words: names are those of the documents, values without a name of their own keep theirs', async () => {
  const {shownName} = await sources.words();
  assert.deepEqual(['skirt', 'skirting', 'edge', 'came_round'].map(shownName), [
    'boundary',
    'following',
    'boundary',
    'closed loop',
  ]);
  assert.deepEqual(['map', 'gave_up', 'target_free'].map(shownName), ['map', 'gave up', 'target free']);
});
