// Builds the playground: its page, and the file beside it that the page takes for a Pico.
// usage: node playground.mjs MODULES IMAGE.uf2 FOLDER
import {deflateSync} from 'node:zlib';
import {readFile, writeFile} from 'node:fs/promises';
import {join} from 'node:path';
import {bundled, bundledPage, here} from './bundle.mjs';

const MOST = {'index.html': 260_000, 'pico.js': 620_000};

/**
 * The number of zeros that fill the last word, then four bytes in five characters of ( to |, low digit first; } stands
 * for <. src/playground/packed.ts reads it.
 */
function base85(bytes) {
  const fill = -bytes.length & 3;
  const words = Buffer.concat([bytes, Buffer.alloc(fill)]);
  let text = `${fill}`;
  for (let at = 0; at < words.length; at += 4) {
    let word = words.readUInt32LE(at);
    for (let i = 0; i < 5; ++i, word = Math.floor(word / 85)) text += String.fromCharCode(40 + (word % 85));
  }
  return text.replaceAll('<', '}');
}

// With blocks of this size, whose codes follow what is in them, a module is shortest.
const packed = (bytes) => base85(deflateSync(bytes, {level: 9, memLevel: 7}));

async function module(file) {
  const wasm = await readFile(file);
  const imports = WebAssembly.Module.imports(await WebAssembly.compile(wasm));
  if (imports.length > 0) throw new Error(`${file} imports ${imports.map(({name}) => name).join(', ')}`);
  return wasm;
}

/** A script that gives all that a Pico needs to the page. */
async function picoScript(wasm, uf2) {
  const source = (name) => bundled({entryPoints: [here(`src/playground/${name}`).pathname], format: 'iife'});
  const [view, worker, licence] = await Promise.all([
    source('pico_page.ts'),
    source('pico_worker.mjs'),
    readFile(here('../../harness/pico/node_modules/rp2040js/LICENSE'), 'utf8'),
  ]);
  const parts = {worker, module: packed(wasm), image: packed(uf2)};
  return `/*\nrp2040js: ${licence.trim()}\n*/\n${view}\nObject.assign(whiskerPico,${JSON.stringify(parts)})\n`;
}

const [modules, image, folder] = process.argv.slice(2);
if (!folder) {
  console.error('usage: node playground.mjs MODULES IMAGE.uf2 FOLDER');
  process.exit(2);
}
const [plain, withPico, uf2] = await Promise.all([
  module(join(modules, 'whisker.wasm')),
  module(join(modules, 'whisker_pico.wasm')),
  readFile(image),
]);
const files = {
  'index.html': await bundledPage({
    html: 'playground.html',
    sheets: ['style.css', 'playground.css'],
    entry: 'playground/main.ts',
    more: {module: packed(plain)},
  }),
  'pico.js': await picoScript(withPico, uf2),
};
for (const [name, text] of Object.entries(files)) {
  if (text.length > MOST[name]) throw new Error(`${name}: ${text.length} bytes; at most ${MOST[name]}`);
  await writeFile(join(folder, name), text);
  console.log(`${name}: ${text.length} bytes of at most ${MOST[name]}`);
}
