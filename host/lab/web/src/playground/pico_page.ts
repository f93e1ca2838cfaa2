/** The pins of the emulated Pico, for pico.js. */
import {element, make} from '../dom.ts';
import type {PinsView} from './pico.ts';

/** What pico_pins.mjs sees. */
interface Pins {
  ms: number;
  /** Simulated seconds in a second. */
  speed: number;
  led: boolean;
  awake: boolean;
  duties: number[];
  encoders: {count: number; levels: boolean[]}[];
  /** said: the longest answer of late, after the register. */
  sensors: {name: string; address: number; measurements: number; transfers: number; said: string}[];
  /** Of the core, ms. */
  tick: {last: number; worst: number};
  /** That the robot has sent. */
  bytes: number;
  messages: {id: number; name: string; count: number; data: string}[];
  plugs: {name: string; out: boolean}[];
  sins: string[];
}

const STYLE = `
#pins table {width: 100%; margin-bottom: 10px; font-size: 13px}
#pins td {vertical-align: top; padding-right: 10px}
#pins td:last-child {padding-right: 0; width: 58%}
#pins h3 {margin: 12px 0 4px}
#pins code {font-size: 12px; overflow-wrap: anywhere}
#pins td code {display: block; line-height: 1.3}
#pins .light {display: inline-block; width: 11px; height: 11px; border-radius: 50%; background: var(--still); margin-right: 6px}
#pins .light.on {background: var(--goal); box-shadow: 0 0 0 3px color-mix(in srgb, var(--goal) 35%, transparent)}
#pins .level {display: inline-block; width: 1.5em; text-align: center; line-height: 1.1; border-bottom: 2px solid var(--line); color: var(--muted)}
#pins .level.high {border-top: 2px solid var(--ink); border-bottom-color: transparent; color: var(--ink)}
#pins .duty {display: flex; gap: 8px; align-items: center}
#pins .duty .meter {flex: 1; min-width: 50px}
#pins .duty b {min-width: 4em; text-align: right}
#pins .console {max-height: 230px; overflow: auto; border: 1px solid var(--line); border-radius: 5px; padding: 4px 8px}
#pins .console table {margin: 0}
#pins .console td {white-space: nowrap; font-size: 12.5px}
#pins .plugs {display: flex; flex-wrap: wrap; gap: 6px}
`;

/** A second of the robot's time. */
const RATE_MS = 1000;

/** Numbers that grow, as numbers a second of the robot's time. */
class Rates {
  private since = 0;
  private before = new Map<string, number>();
  private last = new Map<string, number>();

  /** True: there are new rates. */
  pass(ms: number, counts: Iterable<[string, number]>): boolean {
    if (ms < this.since) this.before.clear();
    else if (ms - this.since < RATE_MS) return false;
    const now = new Map(counts);
    const scale = 1000 / (ms - this.since);
    this.last = new Map(
      [...now].map(([name, count]) => [name, (count - (this.before.get(name) ?? 0)) * scale]),
    );
    this.before = now;
    this.since = ms;
    return true;
  }
  of(name: string): string {
    return (this.last.get(name) ?? 0).toFixed(0);
  }
}

const levels = (names: string[], high: boolean[]) =>
  names.map((name, i) => make('span', high[i] ? 'level high' : 'level', name));

export class PinsPanel implements PinsView {
  private readonly cells = new Map<string, HTMLElement>();
  private readonly speed = make('p');
  private readonly console = make('tbody');
  private readonly buttons = new Map<string, HTMLElement>();
  private readonly plugs = make('div', 'plugs');
  private readonly sins = make('p', 'bad');
  private readonly rates = new Rates();

  constructor(private readonly tell: (order: object) => void) {
    const style = make('style', '', STYLE);
    const rows = make('tbody', '', [
      this.row('GP25', 'light'),
      ...['left', 'front', 'right'].map((name) => this.row('GP4, 5', `${name} sensor`, 'I2C')),
      this.row('GP4, 5', 'gyro', 'I2C'),
      this.row('GP16, 17', 'left motor', 'PWM'),
      this.row('GP18, 19', 'right motor', 'PWM'),
      this.row('GP20', 'motor driver'),
      this.row('GP10, 11', 'left encoder'),
      this.row('GP12, 13', 'right encoder'),
      this.row('GP21', 'tick'),
      this.row('GP0', 'serial cable'),
    ]);
    const scroll = make('div', 'console', [make('table', '', [this.console])]);
    scroll.tabIndex = 0;
    scroll.setAttribute('role', 'region');
    scroll.setAttribute('aria-label', 'Serial console');
    element('pins').append(
      style,
      this.speed,
      make('table', '', [rows]),
      make('h3', '', 'Pull out while it drives; press again to put it back'),
      this.plugs,
      make('h3', '', 'Serial console: the last message of each kind, and how many a second'),
      scroll,
      this.sins,
    );
  }

  show(told: unknown): void {
    const pins = told as Pins;
    const news = this.rates.pass(pins.ms, [
      ...pins.sensors.flatMap(({name, measurements, transfers}): [string, number][] => [
        [name, measurements],
        [`${name} asked`, transfers],
      ]),
      ...pins.messages.map(({id, count}): [string, number] => [String(id), count]),
      ['serial', pins.bytes],
    ]);
    this.say('light', [make('span', pins.led ? 'light on' : 'light'), text(pins.led ? 'on' : 'off')]);
    for (const {name, address, transfers, said} of pins.sensors) {
      const words = `${this.rates.of(name)} measured, ${this.rates.of(`${name} asked`)} transfers / s`;
      this.say(name === 'gyro' ? name : `${name} sensor`, [
        text(transfers === 0 ? 'not asked: gyro is false' : `0x${address.toString(16)}: ${words}`),
        make('code', 'muted', transfers === 0 ? '' : said),
      ]);
    }
    ['left', 'right'].forEach((side, i) => {
      this.say(`${side} motor`, [duty(pins.duties[i])]);
      const {count, levels: high} = pins.encoders[i];
      this.say(`${side} encoder`, [...levels(['A', 'B'], high), text(` ${count} counts`)]);
    });
    this.say('motor driver', [text(pins.awake ? 'awake' : 'asleep')]);
    this.say('tick', [text(`${pins.tick.last.toFixed(1)} ms of 10, worst ${pins.tick.worst.toFixed(1)} ms`)]);
    this.say('serial cable', [text(`${(Number(this.rates.of('serial')) / 1000).toFixed(0)} kB a second`)]);
    this.speed.textContent = speedWords(pins.speed);
    this.sins.textContent = pins.sins.join('; ');
    this.showPlugs(pins);
    if (news) this.showConsole(pins);
  }

  private row(pin: string, name: string, kind = ''): HTMLElement {
    const cell = make('td');
    this.cells.set(name, cell);
    return make('tr', '', [
      make('td', 'muted number', pin),
      make('td', '', kind ? `${name}, ${kind}` : name),
      cell,
    ]);
  }
  private say(name: string, content: Node[]): void {
    this.cells.get(name)!.replaceChildren(...content);
  }
  private showPlugs({plugs}: Pins): void {
    for (const {name, out} of plugs) {
      let button = this.buttons.get(name);
      if (!button) {
        button = make('button', '', name[0].toUpperCase() + name.slice(1));
        button.setAttribute('type', 'button');
        button.addEventListener('click', () => this.tell({pull: name}));
        this.buttons.set(name, button);
        this.plugs.append(button);
      }
      button.setAttribute('aria-pressed', String(out));
    }
  }
  private showConsole({messages}: Pins): void {
    this.console.replaceChildren(
      ...messages.map(({id, name, data}) =>
        make('tr', '', [
          make('td', 'muted', id.toString(16).padStart(3, '0')),
          make('td', '', name),
          make('td', 'number', this.rates.of(String(id))),
          make('td', '', [make('code', '', data)]),
        ]),
      ),
    );
  }
}

const text = (words: string) => document.createTextNode(words);

function duty(share: number): HTMLElement {
  const meter = make('span', 'meter');
  const place = 50 + 50 * share;
  meter.style.setProperty('--from', `${Math.min(50, place)}%`);
  meter.style.setProperty('--to', `${Math.max(50, place)}%`);
  meter.style.setProperty('--mark', `${place}%`);
  meter.style.setProperty('--key', 'var(--free)');
  return make('span', 'duty', [meter, make('b', 'number', `${(100 * share).toFixed(0)} %`)]);
}

/** How fast this computer is. */
export function speedWords(speed: number): string {
  if (speed === 0) return 'The file that is flashed, build/pico/whisker.uf2, starts.';
  const fast = `This computer emulates ${speed.toFixed(1)} seconds of the chip in a second`;
  return speed >= 1
    ? `${fast}: the robot drives in real time.`
    : `${fast}: it cannot keep up, so the robot drives slower than a real one. Nothing is left out.`;
}

Object.assign(window, {whiskerPico: {Pins: PinsPanel}});
