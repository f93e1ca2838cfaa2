/** The lanes under the world, and the slider over them. */
import type {Run} from './data.ts';
import {element, make, setText, Surface} from './dom.ts';
import type {Player} from './player.ts';
import type {Story} from './story.ts';
import type {Theme} from './theme.ts';

/** Pixels between two lanes. */
const GAP = 4;
/** Pixels of a row of blocks; a phone has less room for each. */
const ROW = {desktop: 24, phone: 20};

export class Timeline {
  private readonly surface: Surface;
  private readonly slider = element<HTMLInputElement>('scrub');
  private changes: number[] = [];

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly theme: Theme,
    private readonly story: Story,
  ) {
    const names = story.lanes.map(({name}) => {
      const span = make('span', 'lane-name', name);
      span.id = `lane-${name}`;
      return span;
    });
    const rows = element('lane-rows');
    for (const old of rows.querySelectorAll('.lane-name')) old.remove();
    rows.prepend(...names);
    for (const [name, pixels] of Object.entries(ROW)) {
      const heights = story.lanes.map((lane) => `${lane.rows * pixels}px`);
      rows.style.setProperty(`--${name}-rows`, heights.join(' '));
    }
    this.surface = new Surface(element<HTMLCanvasElement>('lanes'), () => this.draw());
    this.slider.addEventListener('input', () => player.seek(Number(this.slider.value)));
    this.grow();
  }

  /** The run has more ticks. */
  grow(): void {
    for (const lane of this.story.lanes) lane.grow();
    this.changes = [...new Set(this.story.lanes.flatMap((lane) => lane.changes()))].sort((a, b) => a - b);
    this.slider.max = String(this.player.end);
    this.draw();
  }

  /** The colour of the last state depends on the verdict. */
  end(): void {
    for (const lane of this.story.lanes) lane.reset();
    this.grow();
  }

  draw(): void {
    const c = this.surface.clear();
    const {width, height} = this.surface;
    const {lanes} = this.story;
    const row = (height + GAP) / lanes.reduce((sum, {rows}) => sum + rows, 0);
    c.font = '11px Inter, system-ui, sans-serif';
    c.textBaseline = 'middle';
    c.textAlign = 'left';
    let y = 0;
    for (const lane of lanes) {
      const strip = {y, width, height: lane.rows * row - GAP, x: (tick: number) => this.x(tick)};
      lane.draw(c, this.theme.palette, strip);
      y += lane.rows * row;
    }
  }

  update(): void {
    const {tick} = this.player;
    if (Number(this.slider.value) !== tick) this.slider.value = String(tick);
    element('lanes-head').style.transform = `translateX(${this.x(tick)}px)`;
    // Not on every frame, because a screen reader would never finish.
    if (this.player.playing || this.player.following) return;
    const now = `${this.run.t[tick].toFixed(2)} s. ${this.story.sentence(tick)}`;
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
