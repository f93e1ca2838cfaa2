/** The distance to the goal at each tick: the robot's own estimate, which decides, if the page knows it. */
import type {Run} from './data.ts';

export class WayToGoal {
  readonly distance: number[] = [];
  /** The least distance so far, by that estimate, while the robot followed no boundary. */
  readonly nearest: number[] = [];
  private readonly onBoundary: number;

  constructor(private readonly run: Run) {
    this.onBoundary = run.shared.doings.findIndex(({name}) => name === 'danger');
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
      nearest.push(doing[i] === this.onBoundary ? before : Math.min(before, distance[i]));
    }
  }
}
