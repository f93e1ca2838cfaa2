// The simulator in its own process, asked once a millisecond of the robot's time, without waiting for events.
import {execFileSync, spawn} from 'node:child_process';
import {closeSync, mkdtempSync, openSync, readFileSync, readSync, rmSync, writeSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {Drive} from './drive.mjs';
import {IMAGE, ROOT} from './paths.mjs';

const PROGRAM = process.env.WHISKER_RIG ?? join(ROOT, 'build/host/host/harness/pico/whisker_rig');

export class Rig {
  #buffer = Buffer.alloc(65536);
  #rest = '';
  constructor(args) {
    this.folder = mkdtempSync(join(tmpdir(), 'whisker-rig-'));
    const [there, back] = ['there', 'back'].map((name) => join(this.folder, name));
    execFileSync('mkfifo', [there, back]);
    this.process = spawn('sh', ['-c', 'exec "$0" "$@" <"$THERE" >"$BACK"', PROGRAM, ...args], {
      env: {...process.env, THERE: there, BACK: back},
      stdio: ['ignore', 'ignore', 'inherit'],
    });
    this.out = openSync(there, 'w');
    this.in = openSync(back, 'r');
  }
  ask(line) {
    writeSync(this.out, `${line}\n`);
    for (;;) {
      const end = this.#rest.indexOf('\n');
      if (end >= 0) {
        const answer = this.#rest.slice(0, end);
        this.#rest = this.#rest.slice(end + 1);
        return answer;
      }
      const size = readSync(this.in, this.#buffer);
      if (size === 0) throw new Error('the simulator has ended');
      this.#rest += this.#buffer.toString('latin1', 0, size);
    }
  }
  verdict() {
    return JSON.parse(this.ask('end'));
  }
  close() {
    closeSync(this.out);
    closeSync(this.in);
    rmSync(this.folder, {recursive: true});
  }
}

/** A drive with a simulator of its own. args: of whisker_rig; the sensors are those of their robot's file. */
export function driveOf(args, {image = IMAGE, ...options} = {}) {
  const robot = readFileSync(args[args.indexOf('--robot') + 1], 'utf8');
  return new Drive(new Rig(args), readFileSync(image), {sonar: /^sonar = true/m.test(robot), ...options});
}
