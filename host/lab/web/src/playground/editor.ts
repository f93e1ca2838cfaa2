/** Edits the objects of the world by button, list and key. */
import type {World} from '../data.ts';
import {element} from '../dom.ts';
import {NEW_KINDS, nameOf, same, thingsOf, type NewKind, type Thing} from './things.ts';

export interface Edits {
  select(thing: Thing | null): void;
  move(dx: number, dy: number): void;
  size(factor: number): void;
  remove(): void;
  add(kind: NewKind): void;
}

const STEP = 0.05;
const GROW = 1.15;

export class Editor {
  private readonly list = element<HTMLSelectElement>('things');
  private things: Thing[] = [];
  private shown = '';

  constructor(private readonly edits: Edits) {
    this.list.addEventListener('change', () => {
      edits.select(this.things[this.list.selectedIndex - 1] ?? null);
    });
    for (const kind of NEW_KINDS) element(`add-${kind}`).addEventListener('click', () => edits.add(kind));
    element('remove').addEventListener('click', () => edits.remove());
    element('larger').addEventListener('click', () => edits.size(GROW));
    element('smaller').addEventListener('click', () => edits.size(1 / GROW));
  }

  /** A key on a view; true if it has a function here. */
  key(event: KeyboardEvent): boolean {
    const step = event.shiftKey ? 5 * STEP : STEP;
    const actions: Record<string, () => void> = {
      ArrowLeft: () => this.edits.move(-step, 0),
      ArrowRight: () => this.edits.move(step, 0),
      ArrowUp: () => this.edits.move(0, step),
      ArrowDown: () => this.edits.move(0, -step),
      Delete: () => this.edits.remove(),
      Backspace: () => this.edits.remove(),
      '+': () => this.edits.size(GROW),
      '-': () => this.edits.size(1 / GROW),
      Escape: () => this.edits.select(null),
    };
    const action = actions[event.key];
    action?.();
    return action !== undefined;
  }

  show(world: World, selected: Thing | null): void {
    this.things = thingsOf(world);
    const names = this.things.map((thing) => nameOf(world, thing));
    const all = names.join('\n');
    if (all !== this.shown) {
      this.shown = all;
      this.list.replaceChildren(new Option('nothing selected', ''), ...names.map((name) => new Option(name)));
    }
    this.list.selectedIndex = 1 + this.things.findIndex((thing) => same(thing, selected));
    const removable = selected !== null && selected.kind !== 'start' && selected.kind !== 'goal';
    const sizeable = removable && selected.kind !== 'mover';
    element<HTMLButtonElement>('remove').disabled = !removable;
    for (const id of ['larger', 'smaller']) element<HTMLButtonElement>(id).disabled = !sizeable;
  }
}
