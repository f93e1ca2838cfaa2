/** What the page tells of a run: the same parts show a mission and a drive of the guard. */
import type {Result} from './data.ts';
import type {Lane} from './lanes.ts';
import type {Colour} from './theme.ts';

/** How the path is drawn: a column with the class of each tick, and the looks of the classes. */
export interface WayLooks {
  column: string;
  colours: Colour[];
  widths: number[];
}

export interface Story {
  readonly lanes: Lane[];
  readonly way: WayLooks;
  /** Shows the parts of the page for this kind of run, and sets what does not change. */
  open(): void;
  /** State or reason of a tick, as a word on a colour. */
  chip(tick: number): [words: string, colour: Colour];
  sentence(tick: number): string;
  /** The end in words, and its class for the style sheet. */
  verdict(result: Result): [words: string, outcome: string];
  facts(result: Result | null): [term: string, value: string][];
}

/** Shows the elements for one kind of run and hides those for others. */
export function showPartsOf(kind: 'mission' | 'guard' | 'pico'): void {
  for (const part of document.querySelectorAll<HTMLElement>('[data-of]')) {
    part.hidden = !part.dataset.of!.split(' ').includes(kind);
  }
}
