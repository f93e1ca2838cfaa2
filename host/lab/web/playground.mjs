// Builds the playground's page, one file. usage: node playground.mjs MODULE.wasm PAGE.html
import {deflateSync} from 'node:zlib';
import {readFile, writeFile} from 'node:fs/promises';
import {bundledPage} from './bundle.mjs';

const MOST_BYTES = 260_000;

/**
 * The number of zeros that fill the last word, then four bytes in five characters of ( to |, low digit first; } stands
 * for <. src/playground/main.ts reads it.
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

const [module, file] = process.argv.slice(2);
if (!file) {
  console.error('usage: node playground.mjs MODULE.wasm PAGE.html');
  process.exit(2);
}
const wasm = await readFile(module);
const imports = WebAssembly.Module.imports(await WebAssembly.compile(wasm));
if (imports.length > 0) throw new Error(`the module imports ${imports.map(({name}) => name).join(', ')}`);
const page = await bundledPage({
  html: 'playground.html',
  sheets: ['style.css', 'playground.css'],
  entry: 'playground/main.ts',
  more: {module: base85(deflateSync(wasm, {level: 9}))},
});
if (page.length > MOST_BYTES) throw new Error(`${page.length} bytes; at most ${MOST_BYTES}`);
await writeFile(file, page);
console.log(
  `${file}: ${page.length} bytes, of them ${wasm.length} bytes of WebAssembly before they are packed`,
);
