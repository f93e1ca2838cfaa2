/** The lanes of states and reasons under the world, and the slider over them. */
import {speedOf, type Run, type Seen} from './data.ts';
import {element, setText, Surface} from './dom.ts';
import type {Player} from './player.ts';
import type {Colour, Theme} from './theme.ts';
import {sentence, shownName} from './words.ts';

interface Segment {
  from: number;
  /** The first tick after it. */
  to: number;
  label: string;
  colour: Colour;
}

const STILL = new Set(['facing', 'looking', 'searching', 'surveying', 'idle']);
const OVER = new Set(['arrived', 'unreachable', 'gave_up', 'stopped']);

const WHY_COLOURS: Record<string, Colour> = {
  target_free: 'free',
  at_goal: 'goal',
  table: 'table',
  narrow: 'probing',
  target_blocked: 'danger',
  exit_left: 'danger',
  exit_right: 'danger',
  same_side: 'danger',
  edge: 'danger',
  opening: 'danger',
  way_back: 'danger',
  came_round: 'contact',
  wall_lost: 'contact',
  no_exit: 'contact',
  blind: 'contact',
  fault: 'contact',
  step_budget: 'contact',
  length_budget: 'contact',
  goal_out_of_range: 'contact',
  bumped: 'contact',
};

export function stateColour(run: Seen, tick: number): Colour {
  const mode = run.mode(tick);
  if (OVER.has(mode)) return mode === 'arrived' && !run.offGoal ? 'goal' : 'over';
  if (STILL.has(mode)) return 'still';
  return (['free', 'table', 'probing', 'danger'] as const)[run.column('doing')[tick]];
}

/** The label and the colour of a lane at a tick. */
type Lane = (run: Run, tick: number) => [label: string, colour: Colour];

const GUIDES: Record<string, [label: string, colour: Colour]> = {
  goal: ['straight', 'free'],
  place: ['way point', 'map'],
  wait: ['plans', 'still'],
  none: ['boundary', 'danger'],
};

const LANES: Lane[] = [
  (run, tick) => [shownName(run.mode(tick)), stateColour(run, tick)],
  (run, tick) => {
    const why = run.why(tick);
    const colour = why === 'at_goal' && run.offGoal ? 'over' : (WHY_COLOURS[why] ?? 'still');
    return [shownName(why), colour];
  },
];

/** What leads the map planner; empty before the first movement. */
const MAP_LANE: Lane = (run, tick) =>
  run.why(tick) === 'goal_set' ? ['', 'still'] : GUIDES[run.guide(tick)];

/** Extends the segments to the last tick. */
function extend(all: Segment[], run: Run, lane: Lane): void {
  for (let tick = all.at(-1)?.to ?? 0; tick < run.ticks; ++tick) {
    const [label, colour] = lane(run, tick);
    const last = all[all.length - 1];
    if (last && last.label === label && last.colour === colour) last.to = tick + 1;
    else all.push({from: tick, to: tick + 1, label, colour});
  }
}

export class Timeline {
  private readonly surface: Surface;
  private readonly slider = element<HTMLInputElement>('scrub');
  private readonly lanes: {says: Lane; segments: Segment[]}[];
  /** Ticks at which state or reason changes. */
  private changes: number[] = [];

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly theme: Theme,
  ) {
    this.lanes = (run.map ? [...LANES, MAP_LANE] : LANES).map((says) => ({says, segments: []}));
    element('lane-map').hidden = !run.map;
    element('lane-rows').classList.toggle('three', run.map !== null);
    this.surface = new Surface(element<HTMLCanvasElement>('lanes'), () => this.draw());
    this.slider.addEventListener('input', () => player.seek(Number(this.slider.value)));
    this.grow();
  }

  /** The run has more ticks. */
  grow(): void {
    for (const {says, segments} of this.lanes) extend(segments, this.run, says);
    const starts = this.lanes.slice(0, LANES.length).flatMap(({segments}) => segments.map(({from}) => from));
    this.changes = [...new Set(starts)].sort((a, b) => a - b);
    this.slider.max = String(this.player.end);
    this.draw();
  }

  /** The colour of the last state depends on the verdict. */
  end(): void {
    for (const {segments} of this.lanes) segments.length = 0;
    this.grow();
  }

  draw(): void {
    const c = this.surface.clear();
    const p = this.theme.palette;
    const {width, height} = this.surface;
    const lane = (height + 4) / this.lanes.length - 4;
    c.font = '11px Inter, system-ui, sans-serif';
    c.textBaseline = 'middle';
    c.textAlign = 'left';
    this.lanes.forEach(({segments}, row) => {
      const y = row * (lane + 4);
      for (const {from, to, colour} of segments) {
        const x0 = this.x(from);
        c.fillStyle = p[colour];
        c.fillRect(x0, y, Math.max(0.75, this.x(to) - x0), lane);
      }
      for (const {from, to, label, colour} of segments) {
        const x0 = Math.max(0, this.x(from));
        const room = Math.min(width, this.x(to)) - x0;
        if (c.measureText(label).width + 10 > room) continue;
        c.fillStyle = colour === 'still' ? p.ink : p.panel;
        c.fillText(label, x0 + 5, y + lane / 2 + 0.5);
      }
    });
  }

  update(): void {
    const {tick} = this.player;
    if (Number(this.slider.value) !== tick) this.slider.value = String(tick);
    element('lanes-head').style.transform = `translateX(${this.x(tick)}px)`;
    // Not on every frame, because a screen reader would never finish.
    if (this.player.playing || this.player.following) return;
    const {run} = this;
    const says = sentence(run.mode(tick), run.why(tick), run.guide(tick), speedOf(run, tick));
    const now = `${run.t[tick].toFixed(2)} s. ${says}`;
    this.slider.setAttribute('aria-valuetext', now);
    setText('spoken', now);
  }

  nextChange(): void {
    const next = this.changes.find((tick) => tick > this.player.tick);
    this.player.seek(next ?? this.player.end);
  }

  previousChange(): void {
    const before = this.changes.filter((tick) => tick < this.player.tick);
    this.player.seek(before.length > 0 ? before[before.length - 1] : 0);
  }

  private x(tick: number): number {
    return (tick / this.run.ticks) * this.surface.width;
  }
}
