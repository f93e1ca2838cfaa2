// usage: node host/harness/pico/run.mjs WORLD [--robot FILE] [--seed N] [--limit S] [--misses] [--usb]
//
// The image of the Raspberry Pi Pico drives the simulated robot through a world. Needs build/pico/whisker.uf2 and
// build/host.
import {join} from 'node:path';
import {ROOT} from './paths.mjs';
import {driveOf} from './rig.mjs';
import {XIP_MISS_CYCLES} from './strict.mjs';

const args = process.argv.slice(2);
const take = (name, otherwise) => {
  const at = args.indexOf(name);
  return at < 0 ? otherwise : args.splice(at, 2)[1];
};
const limit = Number(take('--limit', 600));
const robot = take('--robot', join(ROOT, 'host/robots/pico.toml'));
const seed = take('--seed');
const has = (name) => args.includes(name) && args.splice(args.indexOf(name), 1).length > 0;
const countsMisses = has('--misses');
const usb = has('--usb');
if (args.length !== 1) {
  console.error(
    'usage: node host/harness/pico/run.mjs WORLD [--robot FILE] [--seed N] [--limit S] [--misses] [--usb]',
  );
  process.exit(2);
}
const began = process.hrtime.bigint();
const drive = driveOf([args[0], '--robot', robot, ...(seed === undefined ? [] : ['--seed', seed])], {
  prepare: (chip) => (chip.countsMisses = countsMisses),
  usb,
});
let running = false;
drive.until(limit * 1000, (now) => {
  running ||= now.ordered && now.outcome === 'running';
  return (
    now.refused ||
    now.contact ||
    now.fault !== 'none' ||
    (running && now.outcome !== 'running' && drive.stands)
  );
});
const verdict = drive.rig.verdict();
drive.close();
const {chip, body} = drive;
/** Of the ticks with the motors at rest, or of the others; 0: there are none. */
const worst = (atRest, cost = (i) => body.ticks[i]) =>
  body.ticks.reduce((most, _, i) => (body.atRest.has(i) === atRest ? Math.max(most, cost(i)) : most), 0);
const seconds = Number(process.hrtime.bigint() - began) / 1e9;
const figures = {
  ...verdict,
  commands: drive.commands,
  first_command_ms: drive.firstCommandMs,
  tick_cycles_mean: Math.round(body.ticks.reduce((sum, cycles) => sum + cycles, 0) / body.ticks.length),
  tick_cycles_worst: worst(false),
  tick_cycles_worst_at_rest: worst(true),
  ...(countsMisses && {
    misses_mean: Math.round(body.misses.reduce((sum, n) => sum + n, 0) / body.misses.length),
    tick_cycles_worst_with_misses: worst(false, (i) => body.ticks[i] + XIP_MISS_CYCLES * body.misses[i]),
  }),
  ticks_over_3_ms: body.ticks.filter((cycles) => cycles > 375000).length,
  stack_bytes: drive.stack,
  resets: chip.resets.length - 1,
  faults: chip.faults,
  sins: [...chip.sins, ...body.usb.complaints],
  simulated_s_a_second: Number((verdict.time_s / seconds).toFixed(2)),
};
for (const [name, value] of Object.entries(figures))
  console.log(`${name}: ${Array.isArray(value) ? value.join('; ') || 'none' : value}`);
const good =
  verdict.outcome === 'reached' &&
  !verdict.contact &&
  verdict.difference === '' &&
  !figures.sins.length &&
  !chip.faults.length;
process.exit(good ? 0 : 1);
