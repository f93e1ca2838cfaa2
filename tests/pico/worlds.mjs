import {execFileSync} from 'node:child_process';
import {readFileSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {test} from 'node:test';
import {ROOT} from '../../host/harness/pico/paths.mjs';

export const LONG = Boolean(process.env.WHISKER_LONG);
/** A test that takes long. */
export const atNight = LONG ? test : () => {};

export const ROBOT = join(ROOT, 'host/robots/pico.toml');
export const SONAR = join(ROOT, 'host/robots/pico-sonar.toml');
/** A world of this folder, or a file. */
export const world = (name) => (name.includes('/') ? name : join(ROOT, `tests/pico/worlds/${name}.toml`));

let made = 0;
/** A file of the Pico robot, or of another one, with these lines in front, or with a line of it replaced. */
export function robotWith(lines, replaced = '', robot = ROBOT) {
  const file = join(tmpdir(), `whisker-pico-${process.pid}-${++made}.toml`);
  const text = readFileSync(robot, 'utf8');
  writeFileSync(file, replaced === '' ? lines + text : text.replace(replaced, lines));
  return file;
}

/** A file with a world of `whisker world`. */
export function generated(kind, seed) {
  const file = join(tmpdir(), `whisker-pico-${process.pid}-${kind}-${seed}.toml`);
  execFileSync(join(ROOT, 'build/host/whisker'), ['world', kind, '--seed', String(seed), '--out', file]);
  return file;
}
