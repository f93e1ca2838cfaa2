/** The views, one for each robot, with one camera for all. */
import {element} from '../dom.ts';
import {Scenery} from '../scenery.ts';
import type {Theme} from '../theme.ts';
import {Editor} from './editor.ts';
import type {LiveRun} from './live.ts';
import type {Playground} from './playground.ts';
import {View} from './view.ts';

/** The same as the first, for the other robot. */
function secondCard(): HTMLElement {
  const first = element('card-0');
  const second = first.cloneNode(true) as HTMLElement;
  second.id = 'card-1';
  const canvas = second.querySelector('canvas')!;
  canvas.setAttribute('aria-label', canvas.getAttribute('aria-label')!.replace('first', 'second'));
  first.after(second);
  return second;
}

export class Stage {
  readonly cards: HTMLElement[];
  /** The robot that the panels show. */
  focus = 0;
  readonly editor: Editor;
  private readonly views: View[];
  private moved = false;
  private readonly listeners: (() => void)[] = [];

  constructor(
    private readonly play: Playground,
    theme: Theme,
  ) {
    this.editor = new Editor({
      select: (thing) => play.select(thing),
      move: (dx, dy) => this.told(play.move(dx, dy)),
      size: (factor) => this.told(play.size(factor)),
      remove: () => play.remove(),
      add: (kind) => this.told(play.add(kind)),
    });
    this.cards = [element('card-0'), secondCard()];
    this.views = this.cards.map((card, side) => this.view(card, side, theme));
    element('fit').addEventListener('click', () => this.fit());
    play.onChange(() => this.follow());
    this.follow();
    // A second view that has not changed its size does not request it.
    this.fit();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  scenery(): Scenery {
    return this.views[Math.min(this.focus, this.play.runs.length - 1)].scenery;
  }

  fit(): void {
    this.moved = false;
    const {width, height} = this.views[0].surface;
    this.play.fit(width, height);
    this.changed();
  }

  draw(): void {
    this.play.runs.forEach((_, i) => this.views[i].draw(this.play.selected));
  }

  private view(card: HTMLElement, side: number, theme: Theme): View {
    const {play} = this;
    const canvas = card.querySelector('canvas')!;
    const look = () => {
      this.focus = side;
      this.changed();
    };
    card.addEventListener('pointerdown', look);
    canvas.addEventListener('focus', look);
    canvas.addEventListener('keydown', (event) => {
      // Without a selection, the keys are those of the user who drives.
      if (play.drivenByUser && !play.selected) return;
      if (!this.editor.key(event)) return;
      event.preventDefault();
      event.stopPropagation();
    });
    const grip = {
      take: (thing: Parameters<Playground['select']>[0]) => play.select(thing),
      drag: (dx: number, dy: number) => this.drag(dx, dy),
      drop: () => {
        this.rest = [0, 0];
      },
      looked: () => {
        this.moved = true;
        this.changed();
      },
    };
    return new View(canvas, play.runs[side] ?? play.runs[0], play.camera, theme, grip, () => {
      if (!this.moved) this.fit();
      this.changed();
    });
  }

  /** The part of a drag that was refused: an object stopped by a robot continues when the pointer has passed it. */
  private rest: [number, number] = [0, 0];
  private drag(dx: number, dy: number): void {
    this.rest = [this.rest[0] + dx, this.rest[1] + dy];
    // Rounding removes less than a millimetre.
    if (Math.hypot(...this.rest) < 0.002) return;
    if (this.play.move(...this.rest)) this.rest = [0, 0];
  }

  /** The runs or their world have changed. */
  private follow(): void {
    const {play} = this;
    this.cards.forEach((card, i) => {
      card.hidden = i >= play.runs.length;
      const run: LiveRun | undefined = play.runs[i];
      if (run) this.views[i].show(run);
    });
    if (this.focus >= play.runs.length) this.focus = 0;
    element('cards').dataset.count = String(play.runs.length);
    this.editor.show(play.situation.world, play.selected);
    this.cards.forEach((card, i) => card.classList.toggle('focus', i === this.focus && play.runs.length > 1));
  }

  private told(done: boolean): void {
    element('told').textContent = done
      ? ''
      : 'Refused: the object would overlap the robot or its start, is too small, or is one too many.';
  }

  private changed(): void {
    this.cards.forEach((card, i) =>
      card.classList.toggle('focus', i === this.focus && this.play.runs.length > 1),
    );
    for (const listener of this.listeners) listener();
  }
}
