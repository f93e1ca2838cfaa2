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
  arrived: 'Stands at the goal',
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
  at_goal: 'it is there',
  no_exit: 'no heading all around is free',
  step_budget: 'its number of steps is used up',
  something_moves: 'something nearby moves, so it waits, looks or goes around',
  length_budget: 'its length of way is used up',
  cancelled: 'the goal was cancelled',
  fault: 'something failed',
};

export const OUTCOMES: Record<string, string> = {
  reached: 'reached the goal',
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

/** "reached the goal in 23.7 s" */
export function verdict(outcome: string, seconds: number): string {
  const words = OUTCOMES[outcome] ?? outcome;
  return `${words} ${outcome === 'reached' ? 'in' : 'after'} ${seconds.toFixed(1)} s`;
}

/** What happens at a tick, as one sentence. `guide`: what a map says. */
export function sentence(mode: string, why: string, guide = ''): string {
  const because = BECAUSE[why] ?? why;
  const does = (mode === 'going' && LED[guide]) || (DOES[mode] ?? mode);
  return `${does}${because ? `: ${because}` : ''}.`;
}

/** "0.42 m" */
export function metres(x: number, digits = 2): string {
  return `${x.toFixed(digits)} m`;
}

export function degrees(radians: number): number {
  return (radians * 180) / Math.PI;
}
