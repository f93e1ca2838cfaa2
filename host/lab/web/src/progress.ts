/** Why the robot does not get stuck: the boundaries that it followed, with the gain at each leave point. */
import type {Edge, Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {WayToGoal} from './goal.ts';
import type {Player} from './player.ts';
import {metres, shownName} from './words.ts';

/** The robot may leave a boundary when it is nearer to the goal by this, for the reference body of 0.09 m. */
const NEARER = 0.03;
const REFERENCE_RADIUS = 0.09;

function otherRule({planner, map}: Run['info']): string {
  if (map) {
    return (
      'The map leads as long as this brings the robot nearer to the goal. Otherwise the robot falls back to boundary ' +
      'following, by the rule of the boundary planner. The map resumes where the robot is nearer to the goal than ever ' +
      'before. So this ends, too.'
    );
  }
  return planner === null
    ? 'The planner is not known here, so its rule is not known either.'
    : `The rule of the boundary planner does not hold here: this is the ${shownName(planner)} planner.`;
}

const ENDS: Record<Edge['end'], string> = {
  none: '',
  left: '',
  wall_lost: 'lost wall',
  unreachable: 'closed loop: no path',
};

export class ProgressPanel {
  private rows: HTMLElement[] = [];
  private readonly followsBoundaries: boolean;
  private shown = '';

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly way: WayToGoal,
  ) {
    this.followsBoundaries = run.info.planner === 'skirt';
    element('rule-of-progress').hidden = !this.followsBoundaries;
    setText('planner-of-progress', this.followsBoundaries ? '' : otherRule(run.info));
    this.grow();
  }

  /** The run has more ticks. */
  grow(): void {
    const {edges, result} = this.run.info;
    const now = JSON.stringify([edges, result !== null]);
    if (now === this.shown) return;
    this.shown = now;
    element('edges').hidden = edges.length === 0;
    const none = result ? 'It followed no boundary in this run.' : 'It has followed no boundary so far.';
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
    if (!on || !this.followsBoundaries || !this.run.info.inside) return '';
    const nearer = (NEARER * this.run.info.robot.radius) / REFERENCE_RADIUS;
    return (
      `On a boundary now, ${metres(this.way.distance[tick])} from the goal: ` +
      `it may leave below ${metres(this.way.nearest[tick] - nearer)}.`
    );
  }

  private endedHere(): string {
    return this.run.info.result ? 'the run ended here' : '';
  }

  private row(edge: Edge, i: number): HTMLElement {
    const {t} = this.run;
    const met = this.way.distance[edge.hit];
    const left = edge.left === null ? null : this.way.distance[edge.left];
    const jump = make('button', 'link', `${t[edge.hit].toFixed(1)} s`);
    jump.setAttribute('aria-label', `${t[edge.hit].toFixed(1)} s: go to the hit point of boundary ${i + 1}`);
    jump.addEventListener('click', () => this.player.seek(edge.hit));
    return make('tr', '', [
      make('td', 'number', String(i + 1)),
      make('td', 'number', [jump]),
      make('td', 'number', metres(met)),
      make('td', 'number', left === null ? '' : metres(left)),
      make(
        'td',
        'number',
        left === null ? ENDS[edge.end] || this.endedHere() : ENDS[edge.end] || metres(met - left),
      ),
    ]);
  }
}
