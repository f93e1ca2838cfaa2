/** The keys of the view list what occurs in it, and nothing else. */
import type {Colour} from './theme.ts';

/** In the set of a map's states: a planned path. */
export const PLANNED = 4;

function show(selector: string, occurs: (key: DOMStringMap) => boolean): void {
  for (const key of document.querySelectorAll<HTMLElement>(selector)) key.hidden = !occurs(key.dataset);
}

/** Of the path of a mission. */
export function showPathKeys(colours: ReadonlySet<Colour>): void {
  show('[data-colour]', ({colour}) => colours.has(colour as Colour));
}

/** Of maps: states as planning::CellState numbers them, and PLANNED. */
export function showMapKeys(states: ReadonlySet<number>): void {
  show('[data-state]', ({state}) => states.has(Number(state)));
}
