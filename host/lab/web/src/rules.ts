/** The weights of the 25 rules: firmware/fuzzy/exact.hpp in floating point. */
import type {Controller, Variable} from './data.ts';

/** 1 at a term's own centre, 0 at its neighbours', straight between; the outer terms are shoulders. */
export function memberships(variable: Variable, x: number): number[] {
  const centres = variable.terms.map(([, centre]) => centre);
  return centres.map((own, i) => {
    const neighbour = centres[x < own ? i - 1 : i + 1];
    if (x === own || neighbour === undefined) return 1;
    return Math.max(0, 1 - Math.abs(x - own) / Math.abs(neighbour - own));
  });
}

export interface FiredRule {
  /** Indices of the terms of D and of R. */
  d: number;
  r: number;
  weight: number;
}

/** The rules with a weight above zero, the strongest first; none for a table that is not of these rules. */
export function firedRules(controller: Controller, d: number, r: number): FiredRule[] {
  if (controller.turn.length === 0) return [];
  const ofD = memberships(controller.d, d);
  const ofR = memberships(controller.r, r);
  const fired: FiredRule[] = [];
  ofD.forEach((muD, i) =>
    ofR.forEach((muR, j) => {
      const weight = Math.min(muD, muR);
      if (weight > 0) fired.push({d: i, r: j, weight});
    }),
  );
  return fired.sort((a, b) => b.weight - a.weight);
}
