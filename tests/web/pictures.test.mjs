// The pictures in the documents show the pages as they are.
import assert from 'node:assert/strict';
import {cpSync, existsSync, readFileSync, writeFileSync} from 'node:fs';
import {join} from 'node:path';
import {test} from 'node:test';
import {RECORD, sourcesHash} from '../../host/lab/web/sources_hash.mjs';
import {Folder, ROOT} from './scenarios.mjs';

test('the pictures of the pages were drawn from these sources', () => {
  const recorded = existsSync(RECORD) ? readFileSync(RECORD, 'utf8').trim() : '';
  assert.equal(recorded, sourcesHash(), 'draw them anew: npm --prefix host/lab/web run figures');
});

test('another byte in any source is another page', () => {
  const folder = new Folder();
  try {
    const copy = folder.at('src');
    cpSync(join(ROOT, 'host/lab/web/src'), copy, {recursive: true});
    assert.equal(sourcesHash(copy), sourcesHash());
    writeFileSync(join(copy, 'playground/share.ts'), '\n', {flag: 'a'});
    assert.notEqual(sourcesHash(copy), sourcesHash());
  } finally {
    folder.remove();
  }
});
