/** The controls of world, planner and speed, and the keys. */
import {element, make, setText} from '../dom.ts';
import {showMapKeys, showPathKeys} from '../legend.ts';
import {ending, shownName} from '../words.ts';
import {YOU} from './driver.ts';
import {PICO} from './pico.ts';
import type {Playground} from './playground.ts';
import type {Stage} from './stage.ts';

const SPEEDS = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64];
const WORLD_WORDS: Record<string, string> = {
  discs: '30 discs',
  poles: 'discs and poles',
  'u-trap': 'U-trap',
  spiral: 'spirals and traps',
  maze: 'maze',
  rooms: 'rooms',
  enclosed: 'no way to the goal',
};

export class Controls {
  private readonly kind = element<HTMLSelectElement>('kind');
  private readonly seed = element<HTMLInputElement>('seed');
  private readonly speed = element<HTMLSelectElement>('speed');

  constructor(
    private readonly play: Playground,
    private readonly stage: Stage,
    kinds: string[],
  ) {
    this.kind.replaceChildren(...kinds.map((kind) => new Option(WORLD_WORDS[kind] ?? kind, kind)));
    this.kind.addEventListener('change', () => this.world(this.kind.value, play.state.seed));
    this.seed.addEventListener('change', () => this.world(play.state.kind, Number(this.seed.value)));
    element('next-seed').addEventListener('click', () => this.world(play.state.kind, play.state.seed + 1));
    element('original').addEventListener('click', () => this.world(play.state.kind, play.state.seed));
    element('who').replaceChildren(
      ...Object.entries(play.teams).map(([who, team]) => this.whoButton(who, team)),
    );
    this.speed.replaceChildren(...SPEEDS.map((s) => new Option(`${s}×`, String(s))));
    this.speed.value = String(play.speed);
    this.speed.addEventListener('change', () => (play.speed = Number(this.speed.value)));
    element('play').addEventListener('click', () => this.toggle());
    element('again').addEventListener('click', () => play.begin());
    element('finish').addEventListener('click', () => play.hurry());
    document.addEventListener('keydown', (event) => this.key(event));
    const keys = element<HTMLDialogElement>('keys');
    for (const id of ['help', 'help-keys']) {
      element(id).addEventListener('click', () => (keys.open ? keys.close() : keys.showModal()));
    }
  }

  update(): void {
    const {play} = this;
    const {kind, seed, who, own} = play.state;
    this.kind.value = kind;
    if (document.activeElement !== this.seed) this.seed.value = String(seed);
    for (const name of Object.keys(play.teams)) {
      element(`who-${name}`).setAttribute('aria-pressed', String(name === who));
    }
    showMapKeys(new Set(play.runs.flatMap(({map}) => [...(map?.holds ?? [])])));
    if (!play.drivenByUser) {
      element('course-key').hidden = false;
      showPathKeys(new Set(play.runs.flatMap(({stretches, looks}) => stretches.map(({kind}) => looks.colours[kind])))); // prettier-ignore
    }
    element('original').hidden = own === null;
    element('play').setAttribute('aria-label', play.playing ? 'Pause' : 'Play');
    element('play').classList.toggle('playing', play.playing);
    setText('clock', `${play.time.toFixed(1)} s`);
    // Not on every frame, because a screen reader would never finish.
    const over = play.runs.filter((run) => run.over);
    setText('spoken', over.map((run) => `${shownName(run.planner)}: ${ending(run.ended!)}`).join('. '));
  }

  private world(kind: string, seed: number): void {
    const {play, stage} = this;
    const good = Number.isSafeInteger(seed) && seed >= 0;
    const done = good && play.restore({...play.state, kind, seed, own: null});
    setText('told', done ? '' : 'There is no such world: select another seed, a whole number from 0 on.');
    if (done) {
      play.playing = true;
      stage.fit();
    }
    this.seed.value = String(play.state.seed);
  }

  /** "Boundary planner", "Boundary and map". */
  private whoButton(who: string, team: readonly string[]): HTMLElement {
    const names = team.map(shownName);
    const words =
      {[YOU]: 'Drive it yourself', [PICO]: 'A Pico'}[who] ??
      (names.length > 1 ? names.join(' and ') : `${names[0]} planner`);
    const button = make('button', '', words[0].toUpperCase() + words.slice(1));
    button.id = `who-${who}`;
    button.setAttribute('type', 'button');
    button.addEventListener('click', () => {
      this.play.setWho(who);
      this.stage.fit();
    });
    return button;
  }

  private toggle(): void {
    const {play} = this;
    if (play.over) play.begin();
    play.setPlaying(!play.playing);
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    // The keys of a driver have another meaning.
    if (event.defaultPrevented) return;
    if (event.ctrlKey || event.altKey || event.metaKey || element<HTMLDialogElement>('keys').open) return;
    if (['INPUT', 'SELECT', 'TEXTAREA'].includes(target.tagName)) return;
    // These keys press the button that has the focus.
    if (target.tagName === 'BUTTON' && [' ', 'Enter'].includes(event.key)) return;
    const actions: Record<string, () => void> = {
      ' ': () => this.toggle(),
      r: () => this.play.begin(),
      '0': () => this.stage.fit(),
      d: () => element('theme').click(),
      n: () => this.world(this.play.state.kind, this.play.state.seed + 1),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }
}
