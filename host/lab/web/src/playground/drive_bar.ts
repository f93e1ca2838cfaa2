/** What the user asks for and gets, the switches of the guard, and the contacts. */
import {element, make, setText} from '../dom.ts';
import {REASONS} from '../guard_words.ts';
import {degrees, shownName} from '../words.ts';
import {SWITCHES, type Driver, type Switches} from './driver.ts';
import {GuardRun} from './guard_run.ts';
import {Hand} from './hand.ts';
import type {Playground} from './playground.ts';
import {showPartsOf} from '../story.ts';

const HINT = 'Drive with the arrow keys, W A S D or the joystick, and try to hit something.';
const OVER = 'The drive is over: Again, or the key r, puts the robot back to its start.';

/** There, world and joystick do not fit below the head of the page. */
const SMALL = '(max-width: 560px), (max-height: 640px)';

/** A scale from -1 to 1 with what is granted as an area and what is asked as a mark. */
function showMeter(id: string, asked: number, granted: number, colour: string): void {
  const place = (x: number) => 50 + 50 * Math.max(-1, Math.min(1, x));
  const style = element(id).style;
  style.setProperty('--from', `${Math.min(50, place(granted))}%`);
  style.setProperty('--to', `${Math.max(50, place(granted))}%`);
  style.setProperty('--mark', `${place(asked)}%`);
  style.setProperty('--key', `var(--${colour})`);
}

export class DriveBar {
  private readonly hand: Hand;
  private shown = '';
  /** By reason. */
  private readonly keys: HTMLElement[];

  constructor(
    private readonly play: Playground,
    private readonly driver: Driver,
    reasons: string[],
    private readonly most: {forward: number; turning: number},
  ) {
    this.hand = new Hand({
      steers: () => play.drivenByUser,
      ask: (ahead, left) => {
        driver.ask(ahead, left);
        this.showKnob();
        const moves = ahead !== 0 || left !== 0;
        if (moves && play.drivenByUser && !play.playing && !play.over) play.setPlaying(true);
      },
    });
    for (const name of SWITCHES) {
      element(`switch-${name}`).addEventListener('click', () => this.toggle(name));
    }
    this.keys = reasons.map((reason) => {
      const key = make('span', 'key');
      key.style.setProperty('--key', `var(--${REASONS[reason].colour})`);
      const item = make('li', '', [key, document.createTextNode(shownName(reason))]);
      item.hidden = true;
      return item;
    });
    element('clear-key').before(...this.keys);
  }

  update(): void {
    const {play, driver} = this;
    if (this.shown !== play.kind) {
      this.shown = play.kind;
      showPartsOf(play.kind);
      this.hand.release();
      if (play.drivenByUser && matchMedia(SMALL).matches) element('cards').scrollIntoView();
    }
    const run = play.runs[0];
    const drives = run instanceof GuardRun;
    const came = new Set(run.stretches.map(({kind}) => kind));
    this.keys.forEach((key, reason) => (key.hidden = !drives || !came.has(reason)));
    if (!drives) return;
    this.showKnob();
    setText('drive-hint', run.over ? OVER : HINT);
    for (const name of SWITCHES) {
      const button = element<HTMLButtonElement>(`switch-${name}`);
      button.setAttribute('aria-pressed', String(driver.switches[name]));
      button.disabled = name !== 'guarded' && !driver.switches.guarded;
    }
    const {asked, guarded} = run.grant;
    const granted = guarded ? run.granted : {forward: 0, turning: 0};
    for (const part of ['forward', 'turning'] as const) {
      showMeter(`meter-${part}`, asked[part] / this.most[part], granted[part] / this.most[part], run.colour);
    }
    setText('asked-forward', asked.forward.toFixed(2));
    setText('granted-forward', guarded ? granted.forward.toFixed(2) : '-');
    setText('asked-turning', degrees(asked.turning).toFixed(0));
    setText('granted-turning', guarded ? degrees(granted.turning).toFixed(0) : '-');
    setText('contacts-guarded', String(driver.contacts.guarded));
    setText('contacts-bare', String(driver.contacts.bare));
    element('contacts-guarded').classList.toggle('bad', driver.contacts.guarded > 0);
    const bare = driver.switches.guarded ? '' : ' --bare';
    const rules = play.opened ? ' --rules RULES.fis' : '';
    setText(
      'command',
      `whisker guard SCENARIO.toml --commands DRIVE.csv --time ${run.result.time.toFixed(2)}${bare}${rules} --html drive.html`,
    );
  }

  private showKnob(): void {
    const [ahead, left] = this.driver.stick;
    element('knob').style.transform = `translate(${-left * 100}%, ${-ahead * 100}%)`;
  }

  private toggle(name: keyof Switches): void {
    const {driver, play} = this;
    driver.switches = {...driver.switches, [name]: !driver.switches[name]};
    play.rewire();
  }
}
