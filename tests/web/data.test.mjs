// The data in the page is the data of the trace.
import assert from 'node:assert/strict';
import {describe, test} from 'node:test';
import {inBrowser} from './in_browser.mjs';
import {U_TRAP, withoutOrigin} from './scenarios.mjs';

// Half a unit of the trace's last decimal, and a little for the arithmetic.
const TOLERANCES = {
  t_s: 1e-9,
  x_m: 6e-7,
  y_m: 6e-7,
  heading_rad: 6e-7,
  left_m: 1e-9,
  front_m: 1e-9,
  right_m: 1e-9,
  v_left_mps: 6e-6,
  v_right_mps: 6e-6,
  t: 0,
  looked: 0,
  pressed: 0,
  d: 6e-5,
  r: 6e-5,
  sa: 6e-6,
  sd: 6e-6,
  cmd_left_mps: 1e-9,
  cmd_right_mps: 1e-9,
  est_x_m: 6e-7,
  est_y_m: 6e-7,
  est_heading_rad: 6e-7,
  way_x_m: 6e-7,
  way_y_m: 6e-7,
  sigma_along_m: 6e-7,
  sigma_across_m: 6e-7,
  sigma_heading_rad: 6e-7,
  bend_rad: 6e-5,
  pace_mps: 6e-4,
};
const WORDS = {state: 'mode', why: 'why', guide: 'guide'};
const BEAMS = ['left_m', 'front_m', 'right_m'];

/** Every column of the trace at these ticks, as the page decodes it. */
function decoded(page, ticks) {
  return page.evaluate(
    ({wanted, names, beams, words}) => {
      const {run} = window.whisker;
      return wanted.map((tick) => {
        const row = Object.fromEntries(names.map((name) => [name, run.column(name)[tick]]));
        beams.forEach((name, i) => (row[name] = run.range(i, tick)));
        for (const [name, method] of Object.entries(words)) row[name] = run[method](tick);
        if (!['goal', 'place'].includes(row.guide)) row.way_x_m = row.way_y_m = null;
        if (row.sigma_along_m === 0) row.sigma_along_m = row.sigma_across_m = row.sigma_heading_rad = null;
        return row;
      });
    },
    {
      wanted: ticks,
      names: Object.keys(TOLERANCES).filter((name) => !BEAMS.includes(name)),
      beams: BEAMS,
      words: WORDS,
    },
  );
}

describe('the decoded data', () => {
  const {folder, openPage} = inBrowser();

  const runs = {
    'u-trap': () => folder.run('u-trap', U_TRAP),
    noise: () => folder.drive('noise', ['rooms', '--noise', '--seed', 2]),
    map: () => folder.drive('map', ['rooms', '--noise', '--seed', 4], '--planner', 'map'),
    thesis: () => folder.drive('thesis', ['discs', '--noise', '--seed', 3], '--planner', 'thesis'),
    sigma: () => folder.driveWithSigma('sigma'),
  };
  for (const [name, drive] of Object.entries(runs)) {
    test(`of ${name} is that of its trace`, async () => {
      const result = drive();
      const trace = folder.trace(name);
      const {page, complaints} = await openPage(folder.url(`${name}.html`));
      const ticks = trace.map((_, i) => i).filter((i) => i % 97 === 0 || i === trace.length - 1);
      const rows = await decoded(page, ticks);
      let lost = 0;
      ticks.forEach((tick, i) => {
        assert.deepEqual(
          Object.keys(trace[tick]).sort(),
          [...Object.keys(TOLERANCES), ...Object.keys(WORDS)].sort(),
          'a column of the trace is not compared',
        );
        for (const [column, text] of Object.entries(trace[tick])) {
          const value = rows[i][column];
          if (column in WORDS) assert.equal(value, text, `${column} at tick ${tick}`);
          else if (text === '') assert.equal(value, null, `${column} at tick ${tick}`);
          else {
            assert.ok(
              value !== null && Math.abs(value - Number(text)) <= TOLERANCES[column],
              `${column} at tick ${tick}: ${value} is not ${text}`,
            );
          }
          lost += text === '' ? 1 : 0;
        }
      });
      if (name === 'noise') assert.ok(lost > 0, 'no reading was lost');
      const info = await page.evaluate(() => window.whisker.run.info);
      assert.deepEqual(info.result, withoutOrigin(result));
      assert.deepEqual(complaints, []);
    });
  }

  test('rules weigh up to what the table answers', async () => {
    // docs/rules.md: the table is at most 1.4 % of the span off exact inference.
    const {page} = await openPage(folder.url('noise.html'));
    const rows = await page.evaluate(() => {
      const {run} = window.whisker;
      const {controller} = run.shared;
      const membership = (terms, i, x) => {
        const own = terms[i][1];
        const neighbour = terms[x < own ? i - 1 : i + 1];
        if (x === own || !neighbour) return 1;
        return Math.max(0, 1 - Math.abs(x - own) / Math.abs(neighbour[1] - own));
      };
      const all = [];
      for (let tick = 0; tick < run.ticks; tick += 53) {
        const [d, r] = [run.column('d')[tick], run.column('r')[tick]];
        let [turn, step, total] = [0, 0, 0];
        for (let i = 0; i < 5; ++i) {
          for (let j = 0; j < 5; ++j) {
            const w = Math.min(membership(controller.d.terms, i, d), membership(controller.r.terms, j, r));
            turn += w * controller.turn[i][j][1];
            step += w * controller.step[i][j][1];
            total += w;
          }
        }
        const [cellD, cellR] = [run.column('cell_d')[tick], run.column('cell_r')[tick]];
        const inside = (nodes, cell, x) => x >= nodes[cell] - 1e-9 && x <= nodes[cell + 1] + 1e-9;
        const clamp = (x, nodes) => Math.max(nodes[0], Math.min(nodes[nodes.length - 1], x));
        all.push({
          turn: Math.abs(turn / total - run.column('sa')[tick]),
          step: Math.abs(step / total - run.column('sd')[tick]),
          inCell:
            inside(controller.d_nodes, cellD, clamp(d, controller.d_nodes)) &&
            inside(controller.r_nodes, cellR, clamp(r, controller.r_nodes)),
          asked: d !== 0 || r !== 0,
        });
      }
      return all.filter(({asked}) => asked);
    });
    assert.ok(rows.length > 20);
    for (const {turn, step, inCell} of rows) {
      assert.ok(turn <= 0.0141 * 3, `turn is off by ${turn}`);
      assert.ok(step <= 0.0141 * 2, `step is off by ${step}`);
      assert.ok(inCell, 'the cell in use does not hold what was asked');
    }
  });

  test('the patch is clear under the body, whichever way one comes to a tick', async () => {
    const {page} = await openPage(folder.url('noise.html'));
    const counts = await page.evaluate(() => {
      const {run} = window.whisker;
      const {cell, radius} = run.info.robot;
      const cells = (tick) => {
        const frame = run.film.seek(tick);
        const [x, y] = [run.column('est_x_m')[frame], run.column('est_y_m')[frame]];
        const bodyX = Math.floor(x / cell + 1e-6);
        const bodyY = Math.floor(y / cell + 1e-6);
        let [under, all, sum] = [0, 0, 0];
        run.film.forEachClear(bodyX, bodyY, (i, j) => {
          ++all;
          sum = (sum * 31 + (i - bodyX) * 64 + (j - bodyY)) | 0;
          if (Math.hypot((i + 0.5) * cell - x, (j + 0.5) * cell - y) < radius - 1.5 * cell) ++under;
        });
        return {under, all, sum};
      };
      const ticks = Array.from({length: 60}, (_, i) => Math.floor(((run.ticks - 1) * i) / 59));
      const forth = ticks.map(cells);
      const back = ticks.reverse().map(cells).reverse();
      return {forth, back};
    });
    assert.deepEqual(counts.forth, counts.back);
    const full = Math.PI * 3 ** 2;
    for (const {under, all} of counts.forth) {
      assert.ok(under > 0.7 * full, `only ${under} cells under the body are clear`);
      assert.ok(all <= 32 * 32, `${all} cells are more than the patch has`);
    }
    assert.ok(new Set(counts.forth.map(({sum}) => sum)).size > 30, 'the patch never changes');
  });

  test('every state and reason has plain words', async () => {
    const {page} = await openPage(folder.url('u-trap.html'));
    const {modes, whys, faults, guides} = await page.evaluate(() => window.whisker.run.shared);
    const {DOES, BECAUSE, FAULTS, LED, sentence} = await import('./sources.mjs').then(({words}) => words());
    assert.deepEqual([...modes].sort(), Object.keys(DOES).sort());
    assert.deepEqual([...whys].sort(), Object.keys(BECAUSE).sort());
    assert.deepEqual([...faults].sort(), Object.keys(FAULTS).sort());
    assert.ok(Object.keys(LED).every((guide) => guides.includes(guide)));
    assert.match(
      sentence('going', 'target_free', 'place'),
      /^Drives to the next way point .* no obstacle is near/,
    );
    assert.equal(sentence('going', 'target_free', 'goal'), sentence('going', 'target_free'));
    assert.equal(sentence('skirting', 'edge', 'place'), sentence('skirting', 'edge'));
  });
});
