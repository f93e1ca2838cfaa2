// Runs a module of this board with this process's standard input and output: node run.mjs MODULE.wasm
import { readFileSync, readSync, writeSync } from "node:fs";

let memory;
const bytes = (at, count) => new Uint8Array(memory.buffer, at, count);

/** All of them, or none: the other end is a file or a pipe. */
function transfer(call, at, count) {
  for (let done = 0; done < count; ) {
    let moved = 0;
    try {
      moved = call(bytes(at, count), done, count - done);
    } catch (error) {
      if (error.code === "EAGAIN") continue;
      if (error.code !== "EOF") throw error;
    }
    if (moved === 0) return 0;
    done += moved;
  }
  return 1;
}

const host = {
  read: (at, count) => transfer((view, offset, length) => readSync(0, view, offset, length), at, count),
  write: (at, count) => transfer((view, offset, length) => writeSync(1, view, offset, length), at, count),
  now_ms: () => Math.floor(performance.now()) >>> 0,
};

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), { host });
memory = instance.exports.memory;
process.exitCode = instance.exports.start();
