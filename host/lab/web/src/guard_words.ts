/** What an operator asks for, what the guard grants, and its reasons, in words and colours. */
import type {Colour} from './theme.ts';
import {degrees} from './words.ts';

interface Reason {
  /** Why the wheels do what they do, as a sentence. */
  says: string;
  colour: Colour;
}

/** By GuardReason of firmware/guard.hpp. */
export const REASONS: Record<string, Reason> = {
  clear: {says: 'The command is granted in full.', colour: 'free'},
  fault: {says: 'Something failed: the wheels stand.', colour: 'contact'},
  stale_ranges: {says: 'A beam has no fresh reading, so it stops.', colour: 'contact'},
  command_timeout: {says: 'There is no command, or the last one is too old, so it stops.', colour: 'still'},
  nodding: {says: 'It turns a beam onto ground that it has not seen, or back.', colour: 'map'},
  obstacle: {says: 'Ground near an echo is in the way.', colour: 'danger'},
  unseen: {says: 'Ground that no beam has seen free is in the way.', colour: 'over'},
  doubt: {says: 'Readings contradict each other, or walls get lost, so it is slower.', colour: 'mover'},
  limits: {says: 'The wheels cannot do what is asked.', colour: 'left'},
  assisted: {
    says: 'The response table bends or slows the command near an obstacle.',
    colour: 'table',
  },
};

/** Without the guard. */
export const BARE: Reason = {says: 'The guard is off: the wheels do what is asked.', colour: 'mover'};

/** Forwards in m/s, counter-clockwise in rad/s. */
export interface Velocity {
  forward: number;
  turning: number;
}

/** Slower, it counts as standing. */
const STANDS_BELOW = {forward: 0.0005, turning: 0.005};

/** "0.30 m/s ahead and 12°/s left" */
export function velocityWords({forward, turning}: Velocity): string {
  const parts: string[] = [];
  if (Math.abs(forward) >= STANDS_BELOW.forward) {
    parts.push(`${Math.abs(forward).toFixed(2)} m/s ${forward > 0 ? 'ahead' : 'back'}`);
  }
  if (Math.abs(turning) >= STANDS_BELOW.turning) {
    parts.push(`${Math.abs(degrees(turning)).toFixed(0)}°/s ${turning > 0 ? 'left' : 'right'}`);
  }
  return parts.join(' and ') || 'nothing';
}

function percent(share: number): string {
  return `${Math.round(100 * share)} %`;
}

/** "40 % of the speed, 100 % of the turning"; only what was asked for. */
export function shareWords({forward, turning}: Velocity, share: Velocity): string {
  const parts: string[] = [];
  if (Math.abs(forward) >= STANDS_BELOW.forward) parts.push(`${percent(share.forward)} of the speed`);
  if (Math.abs(turning) >= STANDS_BELOW.turning) parts.push(`${percent(share.turning)} of the turning`);
  return parts.join(', ');
}
