/** States, reasons and faults of the robot, and its verdicts, in words. */

/** Names that differ from those in traces and on the command line. */
const NAMES: Record<string, string> = {
  skirt: 'boundary',
  skirting: 'following',
  edge: 'boundary',
  came_round: 'closed loop',
};

/** Of a planner, a state or a reason: "boundary", "gave up". */
export function shownName(name: string): string {
  return NAMES[name] ?? name.replaceAll('_', ' ');
}

/** What it does, by state. */
export const DOES: Record<string, string> = {
  idle: 'Stands without a goal',
  facing: 'Turns on the spot to face the goal',
  looking: 'Stands and takes a static scan',
  steering: 'Turns to the heading that the response table requests',
  probing: 'Turns in small steps until the next step is free',
  stepping: 'Drives one step',
  searching: 'Turns to both sides to find a clear heading and the side to follow',
  skirting: 'Follows the boundary of the obstacle',
  surveying: 'Turns to both sides to scan the ground around it before it drives',
  going: 'Drives towards the goal',
  arrived: 'Stands',
  unreachable: 'Stands: the goal cannot be reached',
  gave_up: 'Stands: it gave up',
  stopped: 'Stopped for safety',
};

/** The same while the plan of a map leads to the goal. */
export const LED: Record<string, string> = {
  place: 'Drives to the next way point of its map',
  wait: 'Waits for the next plan of its map',
};

/** Why it does that, by reason. */
export const BECAUSE: Record<string, string> = {
  none: '',
  goal_set: 'it has a new goal',
  target_free: 'no obstacle is near in that direction',
  table: 'an obstacle is near, and the response table deflects the heading away from it',
  narrow: 'the path straight ahead is too narrow, so it takes the next clear heading',
  target_blocked: 'an obstacle blocks the direction of the goal',
  exit_left: 'the clear heading on the left needs the smaller turn',
  exit_right: 'the clear heading on the right needs the smaller turn',
  same_side: 'the direction of the goal is still blocked, so it keeps the side that it chose',
  blind: 'readings are lost, so it waits',
  unknown_ahead: 'part of the ground ahead is unknown',
  edge: 'the direction of the goal is blocked, or the robot is not nearer to the goal than ever before',
  opening: 'the boundary may have an opening, so it searches for a heading into it',
  way_back: 'no other heading is clear, so it goes back in the direction it came from',
  wall_lost:
    'the obstacle that it circled is not the one that separates it from the goal, so it drives to the goal again',
  came_round: 'it has closed the loop and is back at the hit point',
  at_goal: 'by its own estimate it is at the goal',
  no_exit: 'no heading in any direction is clear',
  step_budget: 'its number of steps is used up',
  something_moves: 'something nearby moves, so it waits, looks or goes around',
  length_budget: 'its length of path is used up',
  cancelled: 'the goal was cancelled',
  fault: 'something failed',
  goal_out_of_range: 'the goal is farther out than 1,000 m',
  bumped: 'a bump switch was pressed, so it backs off',
  gyro_rest: 'the bias of its gyro is due to be measured, so it stands',
  tolerance_too_small: "the goal's tolerance is smaller than this robot can keep",
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
  range_unsteady: 'the readings of a beam never agreed',
  no_progress: 'a turn or step did not end',
  pose_out_of_range: 'farther out than 1,000 m',
  wheel_runaway: 'a wheel does not turn as commanded',
  bumper_lost: 'the bump switches gave no state',
  bumper_stuck: 'a bump switch stays pressed',
  range_untrusted: 'the rangefinders cannot be trusted',
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
  wheel_runaways: 'wheels that did not turn as commanded',
  late_ticks: 'late ticks',
  clock_jumps: 'clock jumps',
  bumps: 'bumps',
  bumper_refused: 'ticks without bump switches',
  bumper_stuck: 'stuck bump switches',
};

/** By RangeLevel of firmware/health.hpp. */
export const RANGE_LEVELS: [name: string, warning: string][] = [
  ['trusted', ''],
  ['doubtful', 'The readings contradict each other or the parameters: it drives slowly.'],
  ['untrusted', 'The rangefinders cannot be trusted: it stops.'],
];

/** "0.3 contradictions per metre, 2 % phantoms, 0 % false clears, walls seen up to 67°". */
export function rangeFigures(
  contradictions: number,
  phantoms: number,
  falseClears: number,
  incidence: number,
): string {
  const percent = (share: number) => `${Math.round(100 * share)} %`;
  const walls = incidence > 0 ? `walls seen up to ${incidence}°` : 'incidence not known yet';
  return `${contradictions.toFixed(1)} contradictions per metre, ${percent(phantoms)} phantoms, ${percent(falseClears)} false clears, ${walls}`;
}

/** The terms of D, the nearest first. */
const AHEAD = ['very near ahead', 'near ahead', 'some way ahead', 'far ahead', 'very far ahead'];
/** The terms of R, the most negative first: R is right minus left. */
const SIDES = ['right much nearer', 'right nearer', 'both sides alike', 'left nearer', 'left much nearer'];

/** The condition of a rule: "near ahead, left nearer". */
export function ruleWhen(d: number, r: number): string {
  return `${AHEAD[d]}, ${SIDES[r]}`;
}

/** The answer of a rule: "turn right hard". */
export function ruleThen(turn: number, mostTurn: number): string {
  if (turn === 0) return 'straight on';
  return `turn ${turn > 0 ? 'left' : 'right'}${Math.abs(turn) >= mostTurn ? ' hard' : ''}`;
}

/** The end of a run, as in its verdict. */
export interface Ended {
  outcome: string;
  /** The true distance; null: it is not known. */
  final_distance_m: number | null;
}

/** The robot reports that it is at the goal, and its true place is not known. */
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

/** For a style sheet: `reached` is only a robot that is truly at its goal. */
export function verdictClass(ended: Ended): string {
  return onlyBelieves(ended) ? 'believed' : ended.outcome;
}

/** m/s; a slower robot counts as standing. */
const STANDS_BELOW = 0.01;

/** What the robot does at a tick and why, as one sentence. `guide`: what leads it; `speed`: forwards, m/s. */
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
