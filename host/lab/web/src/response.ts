/** Why the robot turns: the response table, its inputs and outputs, and the active rules. */
import type {Controller, Seen} from './data.ts';
import {element, make, setText} from './dom.ts';
import {HeatMap} from './heatmap.ts';
import {firedRules, type FiredRule} from './rules.ts';
import {asksOfNow, bendOf, paceOf, usesTable} from './table_use.ts';
import type {Theme} from './theme.ts';
import {degrees, ruleThen, ruleWhen} from './words.ts';

const SHOWN_RULES = 4;
const UNKNOWN = 'Inputs and outputs of the table are not known here, because they stay in the controller.';

/** "SA bends the course 12° to the left: right is near." */
function bends(radians: number): string {
  const d = degrees(radians);
  if (Math.abs(d) < 0.5) return '';
  const [to, near] = d > 0 ? ['left', 'right'] : ['right', 'left'];
  return `SA bends the course ${Math.abs(d).toFixed(0)}° to the ${to}: ${near} is near.`;
}

/** "SD sets the pace: 0.25 of 0.30 m/s." */
function paces(speed: number, most: number): string {
  return speed > 0 ? `SD sets the pace: ${speed.toFixed(2)} of ${most.toFixed(2)} m/s.` : '';
}

export class ResponsePanel {
  private readonly maps: HeatMap[];
  private shown = '';

  constructor(
    public run: Seen,
    private readonly player: {readonly tick: number},
    private readonly theme: Theme,
    private readonly controller: Controller,
  ) {
    const p = theme.palette;
    const turn = (): [number, number] => [controller.sa.min, controller.sa.max];
    const step = (): [number, number] => [controller.sd.terms[0][1], controller.sd.terms.at(-1)![1]];
    this.maps = [
      new HeatMap(
        element<HTMLCanvasElement>('heat-turn'),
        controller,
        controller.sa_thousandths,
        turn,
        (c) => [c['turn-right'], c['turn-none'], c['turn-left']],
        p,
      ),
      new HeatMap(
        element<HTMLCanvasElement>('heat-step'),
        controller,
        controller.sd_thousandths,
        step,
        (c) => [c['step-small'], c['step-large']],
        p,
      ),
    ];
    this.restyle();
  }

  /** The palette or the table has changed. */
  restyle(): void {
    this.shown = '';
    setText('table-source', this.controller.source);
    for (const map of this.maps) map.restyle(this.theme.palette);
  }

  update(): void {
    const {run} = this;
    const tick = this.player.tick;
    const at = (name: string) => run.column(name)[tick];
    const inUse = usesTable(run, tick);
    const ofNow = asksOfNow(run, tick);
    const [bend, pace] = [bendOf(run, tick), paceOf(run, tick)];
    const question = `${at('d')} ${at('r')} ${run.mode(tick)} ${ofNow} ${bend} ${pace.toFixed(2)}`;
    if (question === this.shown) return;
    this.shown = question;
    // No answer has a step factor of 0: the table has not been used yet.
    if (at('sd') === 0) {
      this.showUnasked(run.info.inside ? 'The table has not been used yet.' : UNKNOWN);
      return;
    }
    const rules = firedRules(this.controller, at('d'), at('r'));
    for (const map of this.maps) {
      map.show({
        d: at('d'),
        r: at('r'),
        cellD: at('cell_d'),
        cellR: at('cell_r'),
        rules,
        inUse: inUse && ofNow,
      });
    }
    setText('value-d', at('d').toFixed(2));
    setText('value-r', at('r').toFixed(2));
    setText('value-sa', at('sa').toFixed(2));
    setText('value-sd', at('sd').toFixed(2));
    const now = [bends(bend), paces(pace, run.info.robot.max_speed)].filter(Boolean).join(' ');
    setText('table-says', this.says(tick, ofNow, now));
    this.listRules(rules);
  }

  private showUnasked(words: string): void {
    for (const map of this.maps) map.show(null);
    for (const id of ['value-d', 'value-r', 'value-sa', 'value-sd']) setText(id, '-');
    setText('table-says', words);
    element('rules').replaceChildren();
  }

  private says(tick: number, ofNow: boolean, now: string): string {
    if (now && ofNow) return now;
    if (now) return `${now} It asked earlier readings, on which the beams agreed.`;
    const instead = this.run.mode(tick) === 'skirting' ? ': the robot follows a boundary' : '';
    return `Neither answer changes anything now${instead}.`;
  }

  private listRules(rules: FiredRule[]): void {
    const {controller} = this;
    const items = rules.slice(0, SHOWN_RULES).map(({d, r, weight}) => {
      const [turnTerm, turn] = controller.turn[d][r];
      const [stepTerm] = controller.step[d][r];
      const terms = `D ${controller.d.terms[d][0]}, R ${controller.r.terms[r][0]}: SA ${turnTerm}, SD ${stepTerm}`;
      const bar = make('span', 'bar');
      bar.style.setProperty('--share', String(weight));
      const item = make('li', '', [
        make('span', '', `${ruleWhen(d, r)}: ${ruleThen(turn, controller.sa.max)}`),
        bar,
        make('span', 'number', weight.toFixed(2)),
      ]);
      item.title = terms;
      return item;
    });
    element('rules').replaceChildren(...items);
  }
}
