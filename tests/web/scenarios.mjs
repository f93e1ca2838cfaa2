// What whisker writes for these tests. The command is $WHISKER, or build/host/whisker.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {once} from 'node:events';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

export const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const WHISKER = process.env.WHISKER ?? join(ROOT, 'build/host/whisker');

/** The command's standard output. Any verdict is fine; bad input and failures are not. */
export function whisker(...args) {
  try {
    return execFileSync(WHISKER, args.map(String), {
      encoding: 'utf8',
      stdio: ['ignore', 'pipe', 'pipe'],
    });
  } catch (error) {
    if (![3, 4, 5, 6, 7].includes(error.status)) throw error;
    return error.stdout;
  }
}

/** The command while it runs. */
export class Running {
  constructor(...args) {
    this.process = spawn(WHISKER, args.map(String), {stdio: ['ignore', 'pipe', 'pipe']});
    this.out = '';
    this.said = '';
    this.process.stdout.on('data', (text) => (this.out += text));
    this.process.stderr.on('data', (text) => (this.said += text));
    this.closed = once(this.process, 'close');
  }
  /** What a pattern finds in what it says on standard error, as soon as it does. */
  async says(pattern) {
    for (;;) {
      const found = this.said.match(pattern);
      if (found) return found;
      if (this.process.exitCode !== null) throw new Error(`it only said: ${this.said}`);
      await Promise.race([once(this.process.stderr, 'data'), this.closed]);
    }
  }
  /** Where it can be watched. */
  async url() {
    return (await this.says(/watch it at (\S+)/))[1];
  }
  /** Its exit status and the verdict that --json prints. */
  async result() {
    const [status] = await this.closed;
    return {status, ...JSON.parse(this.out)};
  }
  stop(signal = 'SIGINT') {
    this.process.kill(signal);
    return this.closed;
  }
}

export class Folder {
  constructor() {
    this.path = mkdtempSync(join(tmpdir(), 'whisker-web-'));
  }
  at(name) {
    return join(this.path, name);
  }
  url(name, hash = '') {
    return `file://${this.at(name)}${hash}`;
  }
  remove() {
    rmSync(this.path, {recursive: true, force: true});
  }

  /** Writes a world and drives through it: NAME.html, NAME.csv, and the result as an object. */
  drive(name, world, ...options) {
    const scenario = this.at(`${name}.toml`);
    whisker('world', ...world, '--out', scenario);
    return this.run(name, scenario, ...options);
  }
  /** The same with a gyro and a bound of the pose. */
  driveWithSigma(name) {
    const robot = this.at(`${name}_robot.toml`);
    writeFileSync(robot, 'gyro = true\nwheel_scale_sigma = 0.005\n[noise]\ngyro_bias_dps = 1\n');
    return this.drive(name, ['discs', '--noise', '--seed', 3], '--robot', robot);
  }
  /** With the boundary planner, if the options name no other. */
  run(name, scenario, ...options) {
    if (!options.includes('--planner')) options.push('--planner', 'skirt');
    const files = ['--html', this.at(`${name}.html`), '--trace', this.at(`${name}.csv`)];
    return JSON.parse(whisker('run', scenario, ...files, '--json', ...options));
  }

  /** 600 s at 100 Hz: the first mission with noise that would take longer still. */
  tenMinutes(name) {
    const scenario = this.at(`${name}.toml`);
    const kind = ['rooms', '--noise'];
    // A few at a time: their cost is that of their missions.
    const seedFrom = (first) => {
      assert.ok(first <= 300, 'no mission takes that long');
      const all = ['--planner', 'skirt', '--csv', this.at(`${name}_${first}.csv`)];
      whisker('campaign', ...kind, '--seed', first, '--count', 20, ...all);
      const mission = this.trace(`${name}_${first}`).find(({time_s}) => time_s > 601);
      return mission?.seed ?? seedFrom(first + 20);
    };
    const seed = seedFrom(1);
    whisker('world', ...kind, '--seed', seed, '--out', scenario);
    const text = readFileSync(scenario, 'utf8');
    writeFileSync(scenario, text.replace(/^time_limit_s *=.*$/m, 'time_limit_s = 600.0'));
    return this.run(name, scenario);
  }

  /** The rows of NAME.csv as objects of strings. */
  trace(name) {
    const [header, ...lines] = readFileSync(this.at(`${name}.csv`), 'utf8')
      .trimEnd()
      .split('\n');
    const names = header.split(',');
    return lines.map((line) => Object.fromEntries(line.split(',').map((value, i) => [names[i], value])));
  }
}

export const U_TRAP = join(ROOT, 'host/worlds/scenarios/figure8_u_trap.toml');

const ORIGIN = ['schema', 'version', 'seed', 'planner', 'robot_name', 'robot_digest', 'rules_digest'];

/** A result of the command without what it says of how it came about: pages have that elsewhere. */
export function withoutOrigin(result) {
  return Object.fromEntries(Object.entries(result).filter(([key]) => !ORIGIN.includes(key)));
}
