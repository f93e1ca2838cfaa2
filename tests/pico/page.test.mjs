// The first evening of docs/build-a-pico-robot.md: its commands, at the robot behind a pseudo terminal.
import assert from 'node:assert/strict';
import {execFile, spawn} from 'node:child_process';
import {readFileSync} from 'node:fs';
import {join} from 'node:path';
import {createInterface} from 'node:readline';
import {test} from 'node:test';
import {setTimeout as sleep} from 'node:timers/promises';
import {promisify} from 'node:util';
import {ROOT} from '../../host/harness/pico/paths.mjs';

const PAGE = readFileSync(join(ROOT, 'docs/build-a-pico-robot.md'), 'utf8');
const BETWEEN_MS = 2000;
const atNight = process.env.WHISKER_LONG ? test : () => {};
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

/** With a robot behind a pseudo terminal, by these words of scripts/pico. */
async function evening(words, lines, says) {
  const robot = spawn(join(ROOT, 'scripts/pico'), ['--tty', ...words], {stdio: ['ignore', 'pipe', 'ignore']});
  try {
    let cable = null;
    for await (const line of createInterface({input: robot.stdout})) {
      cable = /cable: (\S+)/.exec(line)?.[1] ?? null;
      if (cable !== null) break;
    }
    assert.ok(cable);
    for (const line of lines) {
      const command = line.replace('$CABLE', cable);
      let text = '';
      for (let i = 0; i < TRIES && !says[what(line)].test(text); i++) {
        await sleep(BETWEEN_MS * (i + 1));
        text = await said(command);
      }
      assert.match(text, says[what(line)], command);
    }
  } finally {
    robot.kill('SIGINT');
  }
}

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
