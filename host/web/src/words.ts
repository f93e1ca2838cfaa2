/** The robot's own words, said in plain ones. */

/** What it does, by state. */
export const DOES: Record<string, string> = {
  idle: 'Stands without a goal',
  facing: 'Turns on the spot to face the goal',
  looking: 'Stands and looks',
  steering: 'Turns to the heading that the response table asks for',
  probing: 'Turns aside by small steps until the next step is free',
  stepping: 'Drives one step',
  searching: 'Sweeps its beams to both sides for a way out',
  skirting: 'Follows the edge of what is in the way',
  surveying: 'Turns to both sides to see the ground around it before the first move',
  going: 'Drives towards the goal',
  arrived: 'Stands',
  unreachable: 'Stands: the goal cannot be reached',
  gave_up: 'Stands: it gave up',
  stopped: 'Stopped for safety',
};

/** The same where a map leads it towards the goal. */
export const LED: Record<string, string> = {
  place: 'Drives to the next place on the way that its map knows',
  wait: 'Waits until its map has another plan',
};

/** Why it does that, by reason. */
export const BECAUSE: Record<string, string> = {
  none: '',
  goal_set: 'it has a new goal',
  target_free: 'nothing is near in that direction',
  table: 'something is near, and the response table bends its course away from it',
  narrow: 'the way straight ahead is too narrow, the next free heading is taken',
  target_blocked: 'an obstacle blocks the direction of the goal',
  exit_left: 'the way out on the left needs the smaller turn',
  exit_right: 'the way out on the right needs the smaller turn',
  same_side: 'the goal is still hidden, so it keeps to the side it chose',
  blind: 'readings are lost, so it waits',
  unknown_ahead: 'no beam has seen some of the ground ahead yet',
  edge: 'the direction of the goal is still blocked, or it is not nearer than before',
  opening: 'the edge may have an opening, so it feels for it',
  way_back: 'no other way is free, so it goes back where it came from',
  wall_lost: 'what it went round cannot be what parts it from the goal, so it heads for the goal again',
  came_round: 'it is back where it met the obstacle',
  at_goal: 'by its own estimate it is at the goal',
  no_exit: 'no heading all around is free',
  step_budget: 'its number of steps is used up',
  something_moves: 'something nearby moves, so it waits, looks or goes around',
  length_budget: 'its length of way is used up',
  cancelled: 'the goal was cancelled',
  fault: 'something failed',
  goal_out_of_range: 'the goal is farther out than 1,000 m',
};

const OUTCOMES: Record<string, string> = {
  reached: 'reached the goal',
  off_goal: 'believes it is there',
  unreachable: 'found the goal unreachable',
  gave_up: 'gave up',
  contact: 'touched an obstacle',
  fault: 'stopped with a fault',
};

export const FAULTS: Record<string, string> = {
  none: 'none',
  invalid_params: 'parameters refused',
  clock_jump: 'the clock jumped',
  range_lost: 'a beam was lost for too long',
  drive_refused: 'the drive refused commands',
  encoder_jump: 'the encoders jumped',
  wheels_stalled: 'the wheels stand still',
  range_unsteady: 'a beam never agreed with itself',
  no_progress: 'a turn or step came to no end',
  pose_out_of_range: 'farther out than 1,000 m',
  wheel_runaway: 'a wheel does not turn as it is told',
};

export const COUNTER_WORDS: Record<string, string> = {
  range_refused: 'ticks without any reading',
  range_invalid: 'readings lost',
  range_stale: 'times a beam went stale',
  range_stuck: 'readings of a stuck sensor',
  range_out_of_range: 'readings out of range',
  drive_refused: 'commands refused',
  encoder_refused: 'ticks without counts',
  encoder_jumps: 'encoder jumps',
  wheel_stalls: 'wheel stalls',
  unsteady_looks: 'unsteady looks',
  no_progress: 'moves without progress',
  pose_out_of_range: 'times farther out than 1,000 m',
  wheel_runaways: 'wheels that did not turn as told',
  late_ticks: 'late ticks',
  clock_jumps: 'clock jumps',
};

/** Of the terms of D, the nearest first. */
const AHEAD = ['very near ahead', 'near ahead', 'some way ahead', 'far ahead', 'very far ahead'];
/** Of the terms of R, the most negative first: R is right minus left. */
const SIDES = ['right much nearer', 'right nearer', 'both sides alike', 'left nearer', 'left much nearer'];

/** When the rule of these terms speaks: "near ahead, left nearer". */
export function ruleWhen(d: number, r: number): string {
  return `${AHEAD[d]}, ${SIDES[r]}`;
}

/** What it asks for: "turn right hard". */
export function ruleThen(turn: number, mostTurn: number): string {
  if (turn === 0) return 'straight on';
  return `turn ${turn > 0 ? 'left' : 'right'}${Math.abs(turn) >= mostTurn ? ' hard' : ''}`;
}

/** How a run ended, as far as its verdict tells. */
export interface Ended {
  outcome: string;
  /** True; null: it is not known. */
  final_distance_m: number | null;
}

/** The robot says that it is at the goal; where it is, nobody knows. */
function onlyBelieves({outcome, final_distance_m}: Ended): boolean {
  return outcome === 'reached' && final_distance_m === null;
}

/** "reached the goal", "believes it is there; is 5.83 m off" */
export function ending(ended: Ended): string {
  if (onlyBelieves(ended)) return OUTCOMES.off_goal;
  const words = OUTCOMES[ended.outcome] ?? ended.outcome;
  return ended.outcome === 'off_goal' ? `${words}; is ${metres(ended.final_distance_m!)} off` : words;
}

/** "reached the goal in 23.7 s", "believes it is there; is 5.83 m off, after 23.7 s" */
export function verdict(ended: Ended, seconds: number): string {
  const time = `${seconds.toFixed(1)} s`;
  if (ended.outcome === 'reached' && !onlyBelieves(ended)) return `${ending(ended)} in ${time}`;
  return `${ending(ended)}${ended.outcome === 'off_goal' ? ',' : ''} after ${time}`;
}

/** For a style sheet: only what truly reached its goal is `reached`. */
export function verdictClass(ended: Ended): string {
  return onlyBelieves(ended) ? 'believed' : ended.outcome;
}

/** m/s: slower than this it stands. */
const STANDS_BELOW = 0.01;

/** What happens at a tick, as one sentence. `guide`: what a map says; `speed`: forwards, m/s. */
export function sentence(mode: string, why: string, guide: string, speed: number): string {
  const because = BECAUSE[why] ?? why;
  const does = (mode === 'going' && LED[guide]) || (DOES[mode] ?? mode);
  const moves = Math.abs(speed) >= STANDS_BELOW;
  const now = moves ? does.replace(/^Stands/, 'Comes to a stand').replace(/^Stopped/, 'Stops') : does;
  return `${now}${because ? `: ${because}` : ''}.`;
}

/** "0.42 m" */
export function metres(x: number, digits = 2): string {
  return `${x.toFixed(digits)} m`;
}

export function degrees(radians: number): number {
  return (radians * 180) / Math.PI;
}
