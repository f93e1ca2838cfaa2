/** Buttons and keys. */
import {copied, linkWith} from './address.ts';
import type {Run} from './data.ts';
import {element, setText} from './dom.ts';
import {SPEEDS, type Player} from './player.ts';
import type {Theme} from './theme.ts';
import type {Timeline} from './timeline.ts';
import type {WorldView} from './world.ts';

function speedWords(speed: number): string {
  return `${speed}×`;
}

export class Transport {
  private readonly speed = element<HTMLSelectElement>('speed');

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly timeline: Timeline,
    private readonly world: WorldView,
    private readonly theme: Theme,
    private readonly hash: () => string,
  ) {
    this.speed.replaceChildren(...SPEEDS.map((s) => new Option(speedWords(s), String(s))));
    this.speed.addEventListener('change', () => player.setSpeed(Number(this.speed.value)));
    const clicks: [string, () => void][] = [
      ['play', () => player.toggle()],
      ['back', () => player.seek(player.tick - 1)],
      ['forward', () => player.seek(player.tick + 1)],
      ['previous', () => timeline.previousChange()],
      ['next', () => timeline.nextChange()],
      ['to-live', () => player.seek(player.end)],
      ['copy', () => void this.copy()],
    ];
    for (const [id, action] of clicks) element(id).addEventListener('click', action);
    document.addEventListener('keydown', (event) => this.key(event));
  }

  update(): void {
    const {playing, following, live, speed} = this.player;
    const moving = playing || following;
    element('play').setAttribute('aria-label', moving ? 'Pause' : 'Play');
    element('play').classList.toggle('playing', moving);
    for (const id of ['to-live', 'key-live']) element(id).hidden = !live;
    element('to-live').setAttribute('aria-pressed', String(following));
    if (this.speed.value !== String(speed)) this.speed.value = String(speed);
    setText('clock', `${this.run.t[this.player.tick].toFixed(2)} s`);
    setText('clock-end', `of ${this.run.t[this.player.end].toFixed(1)} s`);
  }

  private async copy(): Promise<void> {
    const done = await copied(linkWith(this.hash()));
    setText('copied', done ? 'Link copied' : 'The address bar has the link');
    setTimeout(() => setText('copied', ''), 2500);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || document.body.dataset.view !== 'run') return;
    const target = event.target as HTMLElement;
    const {player, run} = this;
    if (target.closest('select, dialog')) return;
    if (event.key === ' ' && target.closest('button, a, summary')) return;
    const seconds = (by: number) => player.seekTime(run.t[player.tick] + by);
    const keys: Record<string, () => unknown> = {
      ' ': () => player.toggle(),
      k: () => player.toggle(),
      ArrowLeft: () => (event.shiftKey ? seconds(-1) : player.seek(player.tick - 1)),
      ArrowRight: () => (event.shiftKey ? seconds(1) : player.seek(player.tick + 1)),
      PageDown: () => seconds(-10),
      PageUp: () => seconds(10),
      Home: () => player.seek(0),
      End: () => player.seek(player.end),
      '[': () => this.timeline.previousChange(),
      ']': () => this.timeline.nextChange(),
      '-': () => player.shiftSpeed(-1),
      '+': () => player.shiftSpeed(1),
      '=': () => player.shiftSpeed(1),
      f: () => this.world.toggleFollowing(),
      '0': () => this.world.showAll(),
      m: () => this.world.toggleMap(),
      l: () => player.live && player.seek(player.end),
      d: () => this.theme.toggle(),
      '?': () => element<HTMLDialogElement>('keys').showModal(),
    };
    const action = keys[event.key];
    if (!action) return;
    // Page keys scroll the page unless the slider has the focus.
    if (event.key.startsWith('Page') && target.id !== 'scrub') return;
    event.preventDefault();
    action();
  }
}
