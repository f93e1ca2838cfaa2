/** The current tick in words, counters and faults, and the facts of the run. */
import {COUNTERS, speedOf, type Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {WayToGoal} from './goal.ts';
import type {Player} from './player.ts';
import type {Theme} from './theme.ts';
import {stateColour} from './timeline.ts';
import {
  COUNTER_WORDS,
  FAULTS,
  metres,
  RANGE_LEVELS,
  rangeFigures,
  sentence,
  shownName,
  verdict,
  verdictClass,
} from './words.ts';

const NOISE: [key: string, words: string, factor: number, unit: string][] = [
  ['range_sigma_m', 'range noise', 1000, 'mm'],
  ['range_dropout', 'readings lost', 100, '%'],
  ['range_false_clear', 'false clear', 100, '%'],
  ['wheel_scale_sigma', 'wheel scale error', 100, '%'],
  ['heading_drift_deg_per_sqrt_m', 'heading drift', 1, '°/√m'],
];

function noiseWords(noise: Record<string, number>): string {
  const parts = NOISE.filter(([key]) => noise[key] > 0).map(
    ([key, words, factor, unit]) => `${words} ${Number((noise[key] * factor).toPrecision(3))} ${unit}`,
  );
  return parts.length > 0 ? parts.join(', ') : 'none';
}

/** "map planner, 2048 bytes"; empty if the planner is not known. */
function plannerWords({planner, map}: Run['info']): string {
  if (map) return `map planner, ${map.bytes} bytes`;
  return planner ? `${shownName(planner)} planner` : '';
}

function andMap({planner, map}: Run['info']): string {
  if (map) return ` and a map of ${map.bytes} bytes`;
  return planner ? ' and no map' : '';
}

function orUnknown(distance: number | null): string {
  return distance === null ? 'not known here' : metres(distance, 3);
}

/** On a bus, part of the data stays in the controller. */
function sayWhatIsUnknown(run: Run): void {
  const {inside, map} = run.info;
  element('way-key').hidden = !run.map;
  element('map-unknown').hidden = !map || run.map !== null;
  element('counters-unknown').hidden = inside;
  element('ranges-known').hidden = !inside;
  for (const id of ['course-key', 'rules']) element(id).hidden = !inside;
  element('clear-unknown').hidden = run.hasFilm;
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
  ) {
    const {name, inside} = run.info;
    setText('title', name || 'unnamed scenario');
    setText('planner-name', plannerWords(run.info));
    setText('and-map', andMap(run.info));
    document.title = `${name || 'run'} - Whisker`;
    this.list('under way');
    sayWhatIsUnknown(run);
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
    const {result, planner, map, seed, noise, command} = this.run.info;
    setText('verdict', result ? verdict(result, result.time_s) : unknown);
    element('verdict').dataset.outcome = result ? verdictClass(result) : 'none';
    const facts: [string, string][] = [
      ['planner', map ? plannerWords(this.run.info) : shownName(planner ?? 'not known here')],
      ['noise', noiseWords(noise)],
      ['noise seed', String(seed)],
    ];
    if (result) {
      const clearance =
        result.min_clearance_m < 1000 ? metres(result.min_clearance_m, 3) : 'no obstacle near';
      facts.unshift(
        ['path driven', metres(result.path_m)],
        ['nearest to an obstacle', clearance],
        ['from the goal at the end', orUnknown(result.final_distance_m)],
        ['by its own estimate', orUnknown(result.believed_distance_m)],
      );
      if (result.unreachable_above_m !== undefined) {
        facts.unshift(['if all gaps are below', metres(result.unreachable_above_m, 3)]);
      }
      facts.push(
        ['ticks', String(result.ticks)],
        ['command hash', result.hash],
        ['detail', result.detail || '-'],
      );
    }
    if (this.run.info.detail === 'coarse') facts.push(['stored', 'five ticks a second, to a millimetre']);
    if (command) facts.push(['again', command]);
    element('facts').replaceChildren(
      ...facts.map(([term, value]) => make('div', '', [make('dt', '', term), make('dd', '', value)])),
    );
  }

  update(): void {
    const {run} = this;
    const {tick} = this.player;
    const at = (name: string) => run.column(name)[tick];
    setText('state', shownName(run.mode(tick)));
    element('state').style.setProperty('--chip', this.theme.palette[stateColour(run, tick)]);
    element('state').classList.toggle('pale', stateColour(run, tick) === 'still');
    const speed = speedOf(run, tick);
    const fault = run.shared.faults[at('fault')];
    const named = fault === 'none' ? '' : ` The fault: ${FAULTS[fault] ?? fault}.`;
    setText('sentence', sentence(run.mode(tick), run.why(tick), run.guide(tick), speed) + named);
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
