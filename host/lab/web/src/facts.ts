/** The current tick in words, counters and faults, and the facts of the run. */
import {COUNTERS, speedOf, type Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {WayToGoal} from './goal.ts';
import type {Player} from './player.ts';
import type {Story} from './story.ts';
import type {Theme} from './theme.ts';
import {COUNTER_WORDS, FAULTS, metres, RANGE_LEVELS, rangeFigures} from './words.ts';

function sayWhatIsKnown(run: Run): void {
  element('ranges-known').hidden = !run.info.inside;
  for (const id of ['clear-known', 'clear-key']) element(id).hidden = !run.hasFilm;
  if (!run.hasFilm) {
    element('closeup').setAttribute('aria-label', 'The robot from near, ahead is up, and its three beams');
  }
}

export class Facts {
  private readonly counters: {name: string; value: HTMLElement; item: HTMLElement}[] = [];

  constructor(
    private readonly run: Run,
    private readonly player: Player,
    private readonly theme: Theme,
    private readonly way: WayToGoal,
    private readonly story: Story,
  ) {
    const {name, inside} = run.info;
    setText('title', name || 'unnamed scenario');
    document.title = `${name || 'run'} - Whisker`;
    story.open();
    this.list('under way');
    sayWhatIsKnown(run);
    element('counters').replaceChildren();
    if (!inside) return;
    for (const counter of COUNTERS) {
      const value = make('dd', 'number', '0');
      const item = make('div', 'zero', [make('dt', '', COUNTER_WORDS[counter]), value]);
      element('counters').append(item);
      this.counters.push({name: counter, value, item});
    }
  }

  /** The run has ended, or its connection has. */
  end(): void {
    this.list('broken off');
  }

  /** Two standard deviations of the pose: the distance from the true place, and the heading. */
  private showSigma(): void {
    const at = (name: string) => this.run.column(name)[this.player.tick];
    const within = 2 * Math.hypot(at('sigma_along_m'), at('sigma_across_m'));
    for (const id of ['sigma', 'sigma-key']) element(id).hidden = within === 0;
    setText('now-sigma', `${metres(within)}, ${((at('sigma_heading_rad') * 360) / Math.PI).toFixed(1)}°`);
  }

  private showRanges(): void {
    const at = (name: string) => this.run.column(name)[this.player.tick];
    const [level, warning] = RANGE_LEVELS[at('range_level')];
    setText('range-level', level);
    setText(
      'range-figures',
      rangeFigures(
        at('contradictions_per_m'),
        at('phantom_share'),
        at('false_clear_share'),
        at('incidence_seen_deg'),
      ),
    );
    setText('range-warning', warning);
    element('range-warning').hidden = warning === '';
  }

  /** The facts of the run. `unknown` stands for a missing verdict. */
  private list(unknown: string): void {
    const {result, detail, command} = this.run.info;
    const [words, outcome] = result ? this.story.verdict(result) : [unknown, 'none'];
    setText('verdict', words);
    element('verdict').dataset.outcome = outcome;
    const facts = this.story.facts(result);
    if (detail === 'coarse') facts.push(['stored', 'five ticks a second, to a millimetre']);
    if (command) facts.push(['again', command]);
    element('facts').replaceChildren(
      ...facts.map(([term, value]) => make('div', '', [make('dt', '', term), make('dd', '', value)])),
    );
  }

  update(): void {
    const {run} = this;
    const {tick} = this.player;
    const at = (name: string) => run.column(name)[tick];
    const [state, colour] = this.story.chip(tick);
    setText('state', state);
    element('state').style.setProperty('--chip', this.theme.palette[colour]);
    element('state').classList.toggle('pale', colour === 'still');
    const speed = speedOf(run, tick);
    const fault = run.shared.faults[at('fault')];
    const named = fault === 'none' ? '' : ` The fault: ${FAULTS[fault] ?? fault}.`;
    setText('sentence', this.story.sentence(tick) + named);
    setText('now-time', `${run.t[tick].toFixed(2)} s`);
    setText('now-tick', `tick ${Math.round(run.t[tick] / run.info.robot.period)}`);
    setText('now-distance', metres(this.way.distance[tick]));
    setText('now-speed', `${speed.toFixed(2)} m/s`);
    const turning = (at('v_right_mps') - at('v_left_mps')) / run.info.robot.track;
    setText('now-turn', `${((turning * 180) / Math.PI).toFixed(0)}°/s`);
    setText('fault', FAULTS[fault] ?? fault);
    this.showSigma();
    this.showRanges();
    for (const {name, value, item} of this.counters) {
      const text = String(at(name));
      if (value.textContent === text) continue;
      value.textContent = text;
      item.classList.toggle('zero', text === '0');
    }
  }
}
