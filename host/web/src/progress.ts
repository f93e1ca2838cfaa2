/** Why it does not get stuck: the edges it followed, and how much nearer it left each. */
import type {Edge, Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {Player} from './player.ts';
import {metres} from './words.ts';

/** Left when nearer by this than ever before, for the reference body of 0.09 m. */
const NEARER = 0.03;
const REFERENCE_RADIUS = 0.09;

const ENDS: Record<Edge['end'], string> = {
  none: 'the run ended on it',
  left: '',
  wall_lost: 'not the one it met',
  unreachable: 'all the way round: no way',
};

export class ProgressPanel {
  private readonly rows: HTMLElement[] = [];
  private readonly skirts: boolean;

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly distance: Float64Array,
    private readonly nearest: Float64Array,
  ) {
    this.skirts = run.info.planner === 'skirt';
    element('rule-of-progress').hidden = !this.skirts;
    setText(
      'planner-of-progress',
      this.skirts ? '' : `The rule of the skirt planner does not hold here: this is ${run.info.planner}.`,
    );
    const {edges} = run.info;
    element('edges').hidden = edges.length === 0;
    setText('edges-none', edges.length === 0 ? 'Nothing stood in its way in this run.' : '');
    edges.forEach((edge, i) => this.add(edge, i));
  }

  update(): void {
    const {tick} = this.player;
    this.run.info.edges.forEach(({hit, left}, i) => {
      this.rows[i].classList.toggle('current', hit <= tick && tick < (left ?? Infinity));
      this.rows[i].classList.toggle('later', tick < hit);
    });
    setText('leave-rule', this.leaveRule(tick));
  }

  private leaveRule(tick: number): string {
    const on = this.run.info.edges.find(({hit, left}) => hit <= tick && tick < (left ?? Infinity));
    if (!on || !this.skirts) return '';
    const nearer = (NEARER * this.run.info.robot.radius) / REFERENCE_RADIUS;
    return (
      `On an edge now, ${metres(this.distance[tick])} from the goal: ` +
      `it may leave below ${metres(this.nearest[tick] - nearer)}.`
    );
  }

  private add(edge: Edge, i: number): void {
    const {t} = this.run;
    const met = this.distance[edge.hit];
    const left = edge.left === null ? null : this.distance[edge.left];
    const jump = make('button', 'link', `${t[edge.hit].toFixed(1)} s`);
    jump.setAttribute('aria-label', `${t[edge.hit].toFixed(1)} s: go to where edge ${i + 1} was met`);
    jump.addEventListener('click', () => this.player.seek(edge.hit));
    const row = make('tr', '', [
      make('td', 'number', String(i + 1)),
      make('td', 'number', [jump]),
      make('td', 'number', metres(met)),
      make('td', 'number', left === null ? '' : metres(left)),
      make('td', 'number', left === null ? ENDS[edge.end] : ENDS[edge.end] || metres(met - left)),
    ]);
    this.rows.push(row);
    element('edge-rows').append(row);
  }
}
