/** Light and dark: the system's setting until the user selects another. */
import {element} from './dom.ts';

const KEY = 'whisker-theme';
const PROPERTIES = [
  'ink', 'muted', 'line', 'grid', 'panel', 'ground', 'outside', 'obstacle', 'obstacle-edge', 'wall', 'goal', 'contact',
  'clear', 'unknown', 'body', 'free', 'table', 'probing', 'danger', 'still', 'over', 'left', 'front', 'right', 'mover',
  'map', 'map-free', 'map-suspect', 'map-occupied',
  'turn-right', 'turn-none', 'turn-left', 'step-small', 'step-large', 'accent',
] as const; // prettier-ignore

export type Colour = (typeof PROPERTIES)[number];
export type Palette = Record<Colour, string>;

function read(): Palette {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(PROPERTIES.map((p) => [p, style.getPropertyValue(`--${p}`).trim()])) as Palette;
}

function remembered(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

export class Theme {
  palette: Palette;
  private readonly listeners: (() => void)[] = [];
  private readonly dark = matchMedia('(prefers-color-scheme: dark)');

  constructor() {
    const kept = remembered();
    if (kept) document.documentElement.dataset.theme = kept;
    this.palette = read();
    this.dark.addEventListener('change', () => this.changed());
    element('theme').addEventListener('click', () => this.toggle());
    this.label();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  toggle(): void {
    const next = this.isDark() ? 'light' : 'dark';
    document.documentElement.dataset.theme = next;
    try {
      localStorage.setItem(KEY, next);
    } catch {
      // A page from a file may have no storage; the choice holds while it is open.
    }
    this.changed();
  }

  isDark(): boolean {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === 'dark' : this.dark.matches;
  }

  private changed(): void {
    this.palette = read();
    this.label();
    for (const listener of this.listeners) listener();
  }

  private label(): void {
    element('theme').textContent = this.isDark() ? 'Light' : 'Dark';
  }
}
