// The commands of docs/build-a-pico-robot.md, at the robot behind a pseudo terminal.
import assert from 'node:assert/strict';
import {execFile, spawn} from 'node:child_process';
import {once} from 'node:events';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {createInterface} from 'node:readline';
import {test} from 'node:test';
import {setTimeout as sleep} from 'node:timers/promises';
import {promisify} from 'node:util';
import {ROOT} from '../../host/harness/pico/paths.mjs';
import {atNight} from './worlds.mjs';

const PAGE = readFileSync(join(ROOT, 'docs/build-a-pico-robot.md'), 'utf8');
const BETWEEN_MS = 2000;
const TRIES = 4; // on a computer that is slower than the robot

/** What each of them says. */
const SAYS = {
  'watch --nodes': /controller .*running[^]*base .*running/,
  get: /encoder_counts_per_m +14324/,
  set: /-> 0\.25 m\/s/,
  watch: /ranges \[\d/,
  goal: /reached/,
};

/** `watch --nodes` of "build/host/whisker bench watch --nodes --tty $CABLE". */
const what = (line) =>
  line
    .split(' ')
    .slice(2, line.includes('--nodes') ? 4 : 3)
    .join(' ');

async function said(command) {
  const [program, ...words] = command.split(' ');
  const options = {cwd: ROOT, timeout: 120000};
  const {stdout, stderr} = await promisify(execFile)(program, words, options).catch((error) => error);
  return stdout + stderr;
}

const block = (name) =>
  new RegExp(`<!-- ${name}:begin -->\n\`\`\`\n([^]*?)\`\`\``).exec(PAGE)[1].trim().split('\n');

/** Calls use(cable, says, process) with a robot behind a pseudo terminal, by these words of scripts/pico; says() a line to it. */
async function beside(words, use) {
  const robot = spawn(join(ROOT, 'scripts/pico'), ['--tty', ...words], {stdio: ['pipe', 'pipe', 'ignore']});
  try {
    let cable = null;
    for await (const line of createInterface({input: robot.stdout})) {
      cable = /cable: (\S+)/.exec(line)?.[1] ?? null;
      if (cable !== null) break;
    }
    assert.ok(cable);
    await use(cable, (line) => robot.stdin.write(`${line}\n`), robot);
  } finally {
    robot.kill('SIGINT');
  }
}

/** The processes that this one has started, and theirs. */
const startedBy = (pid) =>
  readFileSync(`/proc/${pid}/task/${pid}/children`, 'latin1')
    .split(' ')
    .filter(Boolean)
    .flatMap((child) => [child, ...startedBy(child)]);

function hasEnded(pid) {
  try {
    return / Z /.test(readFileSync(`/proc/${pid}/stat`, 'latin1'));
  } catch {
    return true;
  }
}

async function soon(what) {
  for (let i = 0; i < 100 && !what(); i++) await sleep(100);
  assert.ok(what(), `${what}`);
}

test('SIGTERM ends the robot, and all that it has started', {timeout: 60000}, () =>
  beside([], async (cable, tell, robot) => {
    await soon(() => startedBy(robot.pid).length > 0);
    const all = [robot.pid, ...startedBy(robot.pid)];
    robot.kill('SIGTERM');
    await soon(() => all.every(hasEnded));
  }),
);

const evening = (words, lines, says) =>
  beside(words, async (cable) => {
    for (const line of lines) {
      const command = line.replace('$CABLE', cable);
      let text = '';
      for (let i = 0; i < TRIES && !says[what(line)].test(text); i++) {
        await sleep(BETWEEN_MS * (i + 1));
        text = await said(command);
      }
      assert.match(text, says[what(line)], command);
    }
  });

test('the commands of the first evening', {timeout: 600000}, async () => {
  const lines = block('evening');
  assert.deepEqual(lines.map(what), Object.keys(SAYS));
  await evening([], lines, SAYS);
});

atNight('with HC-SR04', {timeout: 600000}, async () => {
  const words = 'tests/pico/worlds/discs.toml host/robots/pico-sonar.toml';
  assert.ok(PAGE.includes(words));
  const lines = [...block('sonar'), block('evening').at(-1)];
  await evening(words.split(' '), lines, {...SAYS, set: /sonar: false -> true/});
});

/** The check list, at a robot by these words of scripts/pico, with hands or without: its status, and its file. */
async function listed(words, hands, ...options) {
  const folder = mkdtempSync(join(tmpdir(), 'whisker-selftest-'));
  const file = join(folder, 'selftest.json');
  let status = null;
  const lines = [];
  await beside(words, async (cable, tell) => {
    const [program, ...command] = block('selftest')[0].replace('$CABLE', cable).split(' ');
    // Without a file, it has not met both nodes: a slow computer needs seconds until the robot has started.
    for (let i = 0; i < TRIES && !existsSync(file); i++) {
      await sleep(BETWEEN_MS * (i + 1));
      const bench = spawn(program, [...command, '--out', file, ...options], {cwd: ROOT});
      bench.stdout.resume();
      const ended = once(bench, 'close');
      for await (const line of createInterface({input: bench.stderr})) {
        lines.push(line);
        const sensor = /hold a hand .* the (\w+) sensor/.exec(line)?.[1];
        const wheel = /turn the (\w+) wheel/.exec(line)?.[1];
        if (/Press Enter/.test(line)) bench.stdin.end(hands ? '\n' : '');
        if (!hands) continue;
        tell('hand');
        if (sensor !== undefined) {
          await sleep(1000);
          tell(`hand ${['left', 'front', 'right'].indexOf(sensor)}`);
        } else if (wheel !== undefined) tell(`wheel ${['left', 'right'].indexOf(wheel)} 400`);
      }
      [status] = await ended;
    }
  });
  assert.ok(existsSync(file), lines.join('\n'));
  const result = JSON.parse(readFileSync(file));
  rmSync(folder, {recursive: true});
  return {...result, status};
}

atNight('the check list', {timeout: 600000}, async () => {
  const result = await listed([], true, '--wait', '120');
  assert.deepEqual([result.status, result.passed, result.failed], [0, 14, 0], JSON.stringify(result.steps));
  assert.equal(result.parameters.encoder_counts_per_m, '14324');
});

atNight('the check list, at a robot with other sensors than it believes', {timeout: 600000}, async () => {
  const words = ['tests/pico/worlds/discs.toml', 'host/robots/pico-sonar.toml'];
  const result = await listed(words, false, '--wait', '1');
  assert.deepEqual(
    result.steps.filter(({passed}) => passed).map(({step}) => step),
    ['ticks', 'rest'],
  );
  assert.equal(result.status, 1);
  assert.match(result.steps[0].read, /core_fault/);
});
