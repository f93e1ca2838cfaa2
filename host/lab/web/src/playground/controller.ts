/** The response table in the form of the replay page, from the current rules of the core. */
import type {Controller, Variable} from '../data.ts';
import type {Core} from './core.ts';

const ONE = 16384;
const Q7 = 128;

export const TERMS = {
  d: ['VS', 'S', 'M', 'B', 'VB'],
  r: ['RVB', 'RB', 'CE', 'LB', 'LVB'],
  turn: ['TRVB', 'TRB', 'Z', 'TLB', 'TLVB'],
  step: ['VS', 'S', 'M', 'B', 'VB'],
} as const;
/** The centres of the terms of D and R, raw: firmware/fuzzy/variables.hpp. */
const CENTRES = {d: [128, 384, 640, 896, 1152], r: [-896, -512, 0, 512, 896]};

/** The five answers of each output, raw and rising; the default rules use all of them. */
export interface Answers {
  turn: number[];
  step: number[];
}

export function answersOf(rules: number[]): Answers {
  const distinct = (list: number[]) => [...new Set(list)].sort((a, b) => a - b);
  return {turn: distinct(rules.slice(0, 25)), step: distinct(rules.slice(25))};
}

function variable(symbol: string, meaning: string, min: number, max: number, terms: Variable['terms']) {
  return {symbol, meaning, min, max, terms};
}

function named(names: readonly string[], values: number[], one: number): Variable['terms'] {
  return names.map((name, i) => [name, values[i] / one]);
}

function sizeOf(core: Core): string {
  const {rows, columns} = core.table();
  return `bilinear table of ${rows} × ${columns} nodes`;
}

function describeRules(controller: Controller, core: Core, answers: Answers): void {
  const rules = core.rules();
  const picture = (from: number, values: number[], names: readonly string[]) =>
    TERMS.d.map((_, d) =>
      TERMS.r.map((__, r): [string, number] => {
        const raw = rules[from + 5 * d + r];
        return [names[values.indexOf(raw)] ?? '', raw / ONE];
      }),
    );
  controller.d.terms = named(TERMS.d, CENTRES.d, Q7);
  controller.r.terms = named(TERMS.r, CENTRES.r, Q7);
  controller.sa = variable('SA', 'turn factor', -1.5, 1.5, named(TERMS.turn, answers.turn, ONE));
  controller.sd = variable('SD', 'step factor', 0, 2, named(TERMS.step, answers.step, ONE));
  controller.turn = picture(0, answers.turn, TERMS.turn);
  controller.step = picture(25, answers.step, TERMS.step);
  controller.source = `${sizeOf(core)}, made from the 25 rules on this page`;
}

/** Terms and rules of its rule base are not known: it has no rules, and numbers in the places of the terms. */
function describeTable(controller: Controller, core: Core, answers: Answers): void {
  const numbers = (raws: number[]) => raws.map((raw): [string, number] => [String(raw / Q7), raw / Q7]);
  const inTable = (thousandths: number[]) => thousandths.map((x) => x / 1000);
  controller.d.terms = numbers(CENTRES.d);
  controller.r.terms = numbers(CENTRES.r);
  // The colours of the 25 rules, unless the table goes beyond their answers.
  const most = Math.max(controller.sa.max, ...inTable(controller.sa_thousandths).map(Math.abs));
  controller.sa = variable('SA', 'turn factor', -most, most, []);
  const steps = [...answers.step.map((raw) => raw / ONE), ...inTable(controller.sd_thousandths)];
  const [least, longest] = [Math.min(...steps), Math.max(...steps)];
  controller.sd = variable('SD', 'step factor', least, longest, [
    ['shortest', least],
    ['longest', longest],
  ]);
  controller.turn = [];
  controller.step = [];
  controller.source = `${sizeOf(core)}, opened from a file`;
}

/** Updates what depends on the table; the object and its samples stay the same. */
export function refreshController(
  controller: Controller,
  core: Core,
  answers: Answers,
  opened: boolean,
): void {
  const samples = core.samples();
  for (let i = 0; 2 * i < samples.length; ++i) {
    controller.sa_thousandths[i] = samples[2 * i];
    controller.sd_thousandths[i] = samples[2 * i + 1];
  }
  describeRules(controller, core, answers);
  if (opened) describeTable(controller, core, answers);
}

export function controllerOf(core: Core, answers: Answers): Controller {
  const {rows, columns, spacing} = core.table();
  const nodes = (count: number, low: number, step: number) =>
    Array.from({length: count}, (_, i) => (low + step * i) / Q7);
  const controller: Controller = {
    d: variable('D', 'distance to the obstacles ahead', 0, 10, []),
    r: variable('R', 'right distance minus left distance', -8, 8, []),
    sa: variable('SA', 'turn factor', -1.5, 1.5, []),
    sd: variable('SD', 'step factor', 0, 2, []),
    turn: [],
    step: [],
    samples_per_unit: 4,
    sa_thousandths: [],
    sd_thousandths: [],
    d_nodes: nodes(rows, CENTRES.d[0], spacing[0]),
    r_nodes: nodes(columns, CENTRES.r[0], spacing[1]),
    source: '',
  };
  refreshController(controller, core, answers, false);
  return controller;
}
