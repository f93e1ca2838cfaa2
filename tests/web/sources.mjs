// The page's own modules, bundled on the fly.
import {join} from 'node:path';
import {require} from './browser.mjs';
import {ROOT} from './scenarios.mjs';

async function module(name) {
  const {outputFiles} = await require('esbuild-wasm').build({
    entryPoints: [join(ROOT, 'host/lab/web/src', name)],
    bundle: true,
    write: false,
    format: 'esm',
  });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString('base64')}`);
}

export const words = () => module('words.ts');
export const columns = () => module('columns.ts');
export const link = () => module('link.ts');
export const histogram = () => module('histogram.ts');
export const guardWords = () => module('guard_words.ts');
export const grants = () => module('grants.ts');
export const core = () => module('playground/core.ts');
export const situation = () => module('playground/situation.ts');
export const share = () => module('playground/share.ts');
export const toml = () => module('playground/toml.ts');
export const header = () => module('playground/header.ts');
export const things = () => module('playground/things.ts');
