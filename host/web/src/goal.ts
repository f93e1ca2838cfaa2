/** How far the goal is at each tick: by the robot's own estimate, which decides, where the page knows it. */
import type {Run} from './data.ts';

export class WayToGoal {
  readonly distance: number[] = [];
  /** The nearest that it believed to be while off an edge, so far. */
  readonly nearest: number[] = [];
  private readonly onEdge: number;

  constructor(private readonly run: Run) {
    this.onEdge = run.shared.doings.findIndex(({name}) => name === 'danger');
    this.grow();
  }

  grow(): void {
    const {run, distance, nearest} = this;
    const [goalX, goalY] = run.info.world.goal;
    const x = run.column('est_x_m');
    const y = run.column('est_y_m');
    const doing = run.column('doing');
    for (let i = distance.length; i < run.ticks; ++i) {
      distance.push(Math.hypot(x[i] - goalX, y[i] - goalY));
      const before = i > 0 ? nearest[i - 1] : distance[0];
      nearest.push(doing[i] === this.onEdge ? before : Math.min(before, distance[i]));
    }
  }
}
