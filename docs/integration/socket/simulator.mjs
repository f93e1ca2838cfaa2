#!/usr/bin/env node
// A robot in a room with a gap in its wall, simulated in Node.js alone and driven by `whisker socket --tcp PORT`.
//
// usage: simulator.mjs PORT      exit status 0: at the goal without a contact
// Written from docs/socket.md.
import net from "node:net";
import readline from "node:readline";

const GOAL = { x: 3, y: 0.5 };
const WALLS = [
  [-1, -2, 4, -2], [4, -2, 4, 2], [4, 2, -1, 2], [-1, 2, -1, -2],
  [1.5, -2, 1.5, 0.4], [1.5, 1.4, 1.5, 2],
];
const RAYS = 40; // of a cone, so that what hides between two of them is smaller than 5 mm at 0.5 m

const radians = (degrees) => (degrees * Math.PI) / 180;

function along(x, y, angle, [x1, y1, x2, y2]) {
  const dx = Math.cos(angle), dy = Math.sin(angle), ex = x2 - x1, ey = y2 - y1;
  const det = dx * ey - dy * ex;
  if (Math.abs(det) < 1e-12) return Infinity;
  const far = ((x1 - x) * ey - (y1 - y) * ex) / det, part = ((x1 - x) * dy - (y1 - y) * dx) / det;
  return far >= 0 && part >= 0 && part <= 1 ? far : Infinity;
}

function gap(x, y, [x1, y1, x2, y2]) {
  const ex = x2 - x1, ey = y2 - y1;
  const part = Math.min(1, Math.max(0, ((x - x1) * ex + (y - y1) * ey) / (ex * ex + ey * ey)));
  return Math.hypot(x1 + part * ex - x, y1 + part * ey - y);
}

function reading(beam, body) {
  const c = Math.cos(body.heading), s = Math.sin(body.heading);
  const x = body.x + c * beam.x_m - s * beam.y_m, y = body.y + s * beam.x_m + c * beam.y_m;
  let nearest = Infinity;
  for (let i = 0; i <= RAYS; ++i) {
    const angle = body.heading + radians(beam.angle_deg + beam.cone_deg * (i / RAYS - 0.5));
    for (const wall of WALLS) nearest = Math.min(nearest, along(x, y, angle, wall));
  }
  return nearest < beam.max_m ? nearest : "clear";
}

const socket = net.connect(Number(process.argv[2]), "127.0.0.1");
const answers = readline.createInterface({ input: socket })[Symbol.asyncIterator]();
async function ask(line) {
  socket.write(JSON.stringify(line) + "\n");
  const answer = JSON.parse((await answers.next()).value);
  if (answer.error) throw new Error(answer.error);
  return answer;
}

const robot = await ask({ whisker: 1, goal: { x_m: GOAL.x, y_m: GOAL.y } });
const body = { x: 0, y: 0, heading: 0, left: 0, right: 0 };
let answer;
for (let tick = 0; tick < 60000; ++tick) {
  const t = tick * robot.period_s;
  answer = await ask({
    t_s: t,
    range_m: robot.beams.map((beam) => (tick % 2 === 0 ? reading(beam, body) : null)),
    counts: [body.left, body.right].map((way) => Math.floor(way * robot.encoder_counts_per_m)),
  });
  if (answer.outcome !== "running") break;
  const [left, right] = answer.wheel_mps.map((speed) => speed * robot.period_s);
  const turn = (right - left) / robot.wheel_track_m, middle = body.heading + turn / 2;
  body.x += ((left + right) / 2) * Math.cos(middle);
  body.y += ((left + right) / 2) * Math.sin(middle);
  body.heading += turn;
  body.left += left;
  body.right += right;
  if (WALLS.some((wall) => gap(body.x, body.y, wall) < robot.body_radius_m)) {
    console.error(`contact after ${t.toFixed(2)} s`);
    process.exit(1);
  }
}
socket.end();
console.log(`${answer.outcome} after ${answer.t_s} s, ${Math.hypot(body.x - GOAL.x, body.y - GOAL.y).toFixed(3)} m from the goal`);
process.exitCode = answer.outcome === "reached" ? 0 : 1;
