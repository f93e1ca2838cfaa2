// node golden.mjs kernel.wasm golden.txt: runs the scripted drive in WebAssembly and compares its hashes.
import { readFileSync } from 'node:fs';

const [wasm, golden] = process.argv.slice(2);
let memory;
const env = {
  memcpy: (to, from, n) => (memory().copyWithin(to, from, from + n), to),
  memset: (to, byte, n) => (memory().fill(byte, to, to + n), to),
};
const { exports } = new WebAssembly.Instance(new WebAssembly.Module(readFileSync(wasm)), { env });
memory = () => new Uint8Array(exports.memory.buffer);
const [, drive] = Object.entries(exports).find(([name]) => name.includes('scripted_drive'));

const lines = readFileSync(golden, 'utf8').trim().split('\n');
let wrong = lines.length === 2 ? 0 : 1;
for (const line of lines) {
  const [seed, hash] = line.split(' ').map(BigInt);
  const got = BigInt.asUintN(64, drive(seed));
  console.log(`seed ${seed}: 0x${got.toString(16)}`);
  if (got !== hash) ++wrong;
}
process.exit(wrong);
