/** Why it does not get stuck: the edges it followed, and how much nearer it left each. */
import type {Edge, Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {WayToGoal} from './goal.ts';
import type {Player} from './player.ts';
import {metres} from './words.ts';

/** Left when nearer by this than ever before, for the reference body of 0.09 m. */
const NEARER = 0.03;
const REFERENCE_RADIUS = 0.09;

function notSkirt({planner, map}: Run['info']): string {
  if (map) {
    return (
      'Its map leads as long as that brings it nearer to the goal. Where it does not, it follows the edges by the rule ' +
      'of the skirt planner, and the map leads again where the goal is nearer than ever before. So this ends, too.'
    );
  }
  return planner === null
    ? 'Which planner drives is not known here, and so neither is what keeps it from getting stuck.'
    : `The rule of the skirt planner does not hold here: this is ${planner}.`;
}

const ENDS: Record<Edge['end'], string> = {
  none: '',
  left: '',
  wall_lost: 'not the one it met',
  unreachable: 'all the way round: no way',
};

export class ProgressPanel {
  private rows: HTMLElement[] = [];
  private readonly skirts: boolean;
  private shown = '';

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly way: WayToGoal,
  ) {
    this.skirts = run.info.planner === 'skirt';
    element('rule-of-progress').hidden = !this.skirts;
    setText('planner-of-progress', this.skirts ? '' : notSkirt(run.info));
    this.grow();
  }

  /** The run has more ticks. */
  grow(): void {
    const {edges, result} = this.run.info;
    const now = JSON.stringify([edges, result !== null]);
    if (now === this.shown) return;
    this.shown = now;
    element('edges').hidden = edges.length === 0;
    const none = result ? 'Nothing stood in its way in this run.' : 'Nothing has stood in its way so far.';
    setText('edges-none', edges.length === 0 ? none : '');
    this.rows = edges.map((edge, i) => this.row(edge, i));
    element('edge-rows').replaceChildren(...this.rows);
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
    if (!on || !this.skirts || !this.run.info.inside) return '';
    const nearer = (NEARER * this.run.info.robot.radius) / REFERENCE_RADIUS;
    return (
      `On an edge now, ${metres(this.way.distance[tick])} from the goal: ` +
      `it may leave below ${metres(this.way.nearest[tick] - nearer)}.`
    );
  }

  private onIt(): string {
    return this.run.info.result ? 'the run ended on it' : '';
  }

  private row(edge: Edge, i: number): HTMLElement {
    const {t} = this.run;
    const met = this.way.distance[edge.hit];
    const left = edge.left === null ? null : this.way.distance[edge.left];
    const jump = make('button', 'link', `${t[edge.hit].toFixed(1)} s`);
    jump.setAttribute('aria-label', `${t[edge.hit].toFixed(1)} s: go to where edge ${i + 1} was met`);
    jump.addEventListener('click', () => this.player.seek(edge.hit));
    return make('tr', '', [
      make('td', 'number', String(i + 1)),
      make('td', 'number', [jump]),
      make('td', 'number', metres(met)),
      make('td', 'number', left === null ? '' : metres(left)),
      make(
        'td',
        'number',
        left === null ? ENDS[edge.end] || this.onIt() : ENDS[edge.end] || metres(met - left),
      ),
    ]);
  }
}
