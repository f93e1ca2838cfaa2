/** Why the robot turns: the response table, its inputs and outputs, and the active rules. */
import type {Controller, Seen} from './data.ts';
import {element, make, setText} from './dom.ts';
import {HeatMap} from './heatmap.ts';
import {firedRules, type FiredRule} from './rules.ts';
import {asksOfNow, usesTable} from './table_use.ts';
import type {Theme} from './theme.ts';
import {degrees, ruleThen, ruleWhen} from './words.ts';

const SHOWN_RULES = 4;
const UNKNOWN = 'Inputs and outputs of the table are not known here, because they stay in the controller.';

/** "12 degrees left" */
function sideways(radians: number): string {
  const d = degrees(radians);
  if (Math.abs(d) < 0.5) return 'straight on';
  return `${Math.abs(d).toFixed(0)}° to the ${d > 0 ? 'left' : 'right'}`;
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
    const question = `${at('d')} ${at('r')} ${run.mode(tick)} ${ofNow}`;
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
    const asked = sideways(at('sa') * run.info.robot.base_turn);
    setText('table-says', this.says(tick, inUse, ofNow, asked));
    this.listRules(rules);
  }

  private showUnasked(words: string): void {
    for (const map of this.maps) map.show(null);
    for (const id of ['value-d', 'value-r', 'value-sa', 'value-sd']) setText(id, '-');
    setText('table-says', words);
    element('rules').replaceChildren();
  }

  private says(tick: number, inUse: boolean, ofNow: boolean, asked: string): string {
    if (inUse && ofNow) return `Now it requests ${asked}.`;
    if (inUse)
      return `It requests ${asked}, from earlier readings on which the beams agreed: the readings of this tick differ.`;
    const instead = this.run.mode(tick) === 'skirting' ? ': the robot follows a boundary' : '';
    return `Not in use now${instead}. Its last answer was ${asked}.`;
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
