// usage: node host/harness/pico/run.mjs WORLD [--robot FILE] [--seed N] [--limit S]
//
// The image of the Raspberry Pi Pico drives the simulated robot through a world. Needs build/pico/whisker.uf2 and
// build/host.
import {join} from 'node:path';
import {Drive} from './drive.mjs';
import {ROOT} from './paths.mjs';

const args = process.argv.slice(2);
const take = (name, otherwise) => {
  const at = args.indexOf(name);
  return at < 0 ? otherwise : args.splice(at, 2)[1];
};
const limit = Number(take('--limit', 600));
const robot = take('--robot', join(ROOT, 'host/robots/pico.toml'));
const seed = take('--seed');
if (args.length !== 1) {
  console.error('usage: node host/harness/pico/run.mjs WORLD [--robot FILE] [--seed N] [--limit S]');
  process.exit(2);
}
const began = process.hrtime.bigint();
const drive = new Drive([args[0], '--robot', robot, ...(seed === undefined ? [] : ['--seed', seed])]);
let running = false;
drive.until(limit * 1000, (now) => {
  running ||= now.ordered && now.outcome === 'running';
  return now.contact || now.fault !== 'none' || (running && now.outcome !== 'running' && drive.stands);
});
const verdict = drive.rig.verdict();
drive.close();
const {chip} = drive;
const seconds = Number(process.hrtime.bigint() - began) / 1e9;
console.log({...verdict, sins: chip.sins, faults: chip.faults, resets: chip.resets.length, stack: drive.stack, realtime: verdict.time_s / seconds});
process.exit(verdict.outcome === 'reached' && !verdict.contact && verdict.difference === '' ? 0 : 1);
