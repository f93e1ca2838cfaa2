/** The 25 rules as coloured squares, for either output. A press selects the next answer. */
import {blend, rgb} from '../colour.ts';
import {element, make} from '../dom.ts';
import type {FiredRule} from '../rules.ts';
import type {Theme} from '../theme.ts';
import {ruleWhen} from '../words.ts';
import {answersOf, TERMS, type Answers} from './controller.ts';
import {RULE_FAULTS, type Core} from './core.ts';

const ASKS = {
  turn: ['turn right hard', 'turn right', 'straight on', 'turn left', 'turn left hard'],
  step: ['shortest step', 'short step', 'middle step', 'long step', 'longest step'],
};
const SIGNS = {turn: ['↻', '→', '·', '←', '↺'], step: ['1', '2', '3', '4', '5']};

const WARNINGS: [bits: number, words: string][] = [
  [
    RULE_FAULTS.turnNotMirrored | RULE_FAULTS.stepNotMirrored,
    'Not symmetric: in a mirrored world the robot would not drive the mirrored path.',
  ],
  [RULE_FAULTS.turnsTowardsNearer, 'Unsafe: a rule turns towards the side that is nearer.'],
  [RULE_FAULTS.turnsLessNear, 'Unsafe: a rule turns less for a nearer obstacle.'],
  [RULE_FAULTS.stepsLongerNear, 'Unsafe: a rule steps longer towards a nearer obstacle.'],
];

type Output = 'turn' | 'step';

export class RulesPanel {
  readonly answers: Answers;
  private readonly original: number[];
  private rules: number[];
  private output: Output = 'turn';
  private readonly squares: HTMLButtonElement[] = [];

  constructor(
    private readonly core: Core,
    private readonly theme: Theme,
    private readonly changed: () => void,
  ) {
    this.original = core.rules();
    this.rules = [...this.original];
    this.answers = answersOf(this.original);
    this.build();
    for (const output of ['turn', 'step'] as const) {
      element(`edit-${output}`).addEventListener('click', () => this.edit(output));
    }
    element('rules-reset').addEventListener('click', () => this.set([...this.original]));
    element('rules-mirror').addEventListener('click', () => this.mirror());
    theme.onChange(() => this.draw());
    this.edit('turn');
  }

  /** 50 digits, or null for the default rules. */
  get code(): string | null {
    if (this.rules.every((raw, i) => raw === this.original[i])) return null;
    return this.rules.map((raw, i) => this.valuesAt(i).indexOf(raw)).join('');
  }

  setCode(code: string | null): void {
    this.set(code ? [...code].map((digit, i) => this.valuesAt(i)[Number(digit)]) : [...this.original]);
  }

  /** Marks the active rules. */
  light(fired: FiredRule[]): void {
    const weights = new Map(fired.map(({d, r, weight}) => [5 * d + r, weight]));
    this.squares.forEach((square, i) => square.style.setProperty('--weight', String(weights.get(i) ?? 0)));
  }

  draw(): void {
    const p = this.theme.palette;
    const stops =
      this.output === 'turn'
        ? [p['turn-right'], p['turn-none'], p['turn-left']]
        : [p['step-small'], p['step-large']];
    this.squares.forEach((square, i) => {
      const [d, r] = [Math.floor(i / 5), i % 5];
      const term = this.valuesAt(this.offset + i).indexOf(this.rules[this.offset + i]);
      const [red, green, blue] = blend(stops.map(rgb), term / 4);
      square.style.background = `rgb(${red} ${green} ${blue})`;
      square.style.color = 0.3 * red + 0.59 * green + 0.11 * blue > 135 ? '#141414' : '#ffffff';
      square.textContent = SIGNS[this.output][term];
      const faulty = this.core.atFault(d, r);
      square.classList.toggle('faulty', faulty);
      const own = this.rules[this.offset + i] !== this.original[this.offset + i];
      square.classList.toggle('own', own);
      const says = `${ruleWhen(d, r)}: ${ASKS[this.output][term]}`;
      square.title = `${says} (${TERMS[this.output][term]})`;
      square.setAttribute('aria-label', `${says}${own ? ', changed' : ''}${faulty ? ', at fault' : ''}`);
    });
  }

  private get offset(): number {
    return this.output === 'turn' ? 0 : 25;
  }

  private valuesAt(i: number): number[] {
    return i < 25 ? this.answers.turn : this.answers.step;
  }

  private build(): void {
    const rows: HTMLElement[] = [];
    // D grows upwards, and R to the left, as in the heat maps.
    for (let d = 4; d >= 0; --d) {
      const row = make('div', 'rule-row', [make('span', 'rule-term', TERMS.d[d])]);
      for (let r = 4; r >= 0; --r) {
        const square = make('button', 'rule') as HTMLButtonElement;
        square.type = 'button';
        square.dataset.rule = `${d}${r}`;
        square.addEventListener('click', (event) => this.turnOver(5 * d + r, event.shiftKey ? -1 : 1));
        square.addEventListener('keydown', (event) => this.key(event, d, r));
        row.append((this.squares[5 * d + r] = square));
      }
      rows.push(row);
    }
    const feet = [4, 3, 2, 1, 0].map((r) => make('span', 'rule-term', TERMS.r[r]));
    rows.push(make('div', 'rule-row feet', [make('span', ''), ...feet]));
    element('rule-squares').replaceChildren(...rows);
  }

  private key(event: KeyboardEvent, d: number, r: number): void {
    const by = {ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1]}[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    const clamp = (x: number) => Math.max(0, Math.min(4, x));
    this.squares[5 * clamp(d + by[0]) + clamp(r + by[1])].focus();
  }

  private edit(output: Output): void {
    this.output = output;
    for (const name of ['turn', 'step'] as const) {
      element(`edit-${name}`).setAttribute('aria-pressed', String(name === output));
    }
    this.draw();
  }

  private turnOver(square: number, by: number): void {
    const i = this.offset + square;
    const values = this.valuesAt(i);
    const next = [...this.rules];
    next[i] = values[(values.indexOf(this.rules[i]) + by + 5) % 5];
    this.set(next);
  }

  /** The left half, where the left is nearer, is made the mirror of the right one. */
  private mirror(): void {
    const next = [...this.rules];
    for (let d = 0; d < 5; ++d) {
      next[5 * d + 2] = 0;
      for (let r = 0; r < 2; ++r) {
        next[5 * d + 4 - r] = -next[5 * d + r];
        next[25 + 5 * d + 4 - r] = next[25 + 5 * d + r];
      }
    }
    this.set(next);
  }

  private set(rules: number[]): void {
    this.rules = rules;
    const faults = this.core.setRules(rules);
    const warnings = WARNINGS.filter(([bits]) => faults & bits).map(([, words]) => make('li', '', words));
    element('rule-warnings').replaceChildren(...warnings);
    element('rules-good').hidden = warnings.length > 0;
    this.draw();
    this.changed();
  }
}
