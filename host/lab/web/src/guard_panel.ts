/** What a drive of the guard was like: its counts, the reasons with their times, and plots of its commands. */
import type {Result, Run} from './data.ts';
import {element, make, setText} from './dom.ts';
import type {Grants} from './grants.ts';
import {REASONS} from './guard_words.ts';
import type {Player} from './player.ts';
import {plotOf, type Line, type Plot} from './plots.ts';
import {clearanceWords} from './run_facts.ts';
import {shownName} from './words.ts';

const RULE =
  'The guard passes on what is safe: a speed from which the body can still stop on ground that a beam has seen free.';
const NO_RULE = 'The guard was off: the wheels did what was asked, within their limits.';

/** Forward speed, turning and granted share over time. */
export function guardPlots(grants: Grants): Plot[] {
  const {asked, granted, driven, share, info} = grants;
  const lines = (part: 'forward' | 'turning'): Line[] => [
    {label: 'asked', colour: 'accent', values: () => asked[part], dashed: true},
    ...(info.guarded ? [{label: 'granted', colour: 'free', values: () => granted[part]} as const] : []),
    {label: 'driven', colour: 'table', values: () => driven[part]},
  ];
  const percent = share.forward.map((value) => 100 * value);
  const plots = [
    plotOf('plot-speed', 'm/s', lines('forward'), grants.most('forward')),
    plotOf('plot-turning', 'rad/s', lines('turning'), grants.most('turning')),
  ];
  if (info.guarded) plots.push(plotOf('plot-share', '%', [{label: 'of the asked speed', colour: 'free', values: () => percent}])); // prettier-ignore
  return plots;
}

function tile(term: string, value: string, bad = false): HTMLElement {
  return make('div', bad ? 'bad' : '', [make('dt', '', term), make('dd', '', value)]);
}

function counts(result: Result, guarded: boolean): HTMLElement[] {
  const contacts = result.outcome === 'contact' ? 1 : 0;
  const tiles = [
    tile('contacts', String(contacts), contacts > 0),
    tile('least clearance', clearanceWords(result)),
  ];
  if (!guarded) return tiles;
  const {stops = 0, granted = 1, path_m} = result;
  const rate = path_m > 0 ? ` (${(stops / path_m).toFixed(1)} a metre)` : '';
  return [
    ...tiles,
    tile('speed granted', `${(100 * granted).toFixed(0)} %`),
    tile('stops', `${stops}${rate}`),
  ];
}

export class GuardPanel {
  private readonly rows = new Map<string, HTMLElement>();

  constructor(
    private readonly run: Run,
    private readonly grants: Grants,
    private readonly player: Player,
  ) {
    const {guarded, reasons} = grants.info;
    setText('guard-rule', guarded ? RULE : NO_RULE);
    element('share-plot').hidden = !guarded;
    if (run.info.result) element('guard-counts').replaceChildren(...counts(run.info.result, guarded));
    if (!guarded) return;
    const ticks = reasons.map(() => 0);
    for (const reason of run.column('reason')) ++ticks[reason];
    reasons.forEach((reason, i) => this.addRow(reason, i, ticks[i]));
    const never = reasons.filter((_, i) => ticks[i] === 0).map(shownName);
    setText('reasons-never', never.length > 0 ? `Never: ${never.join(', ')}.` : '');
  }

  update(): void {
    const now = this.grants.reason(this.player.tick);
    for (const [reason, row] of this.rows) row.classList.toggle('current', reason === now);
  }

  private addRow(reason: string, index: number, ticks: number): void {
    if (ticks === 0) return;
    const share = ticks / this.run.ticks;
    const key = make('span', 'key block');
    const bar = make('span', 'bar');
    for (const part of [key, bar]) part.style.setProperty('--key', `var(--${REASONS[reason].colour})`);
    bar.style.setProperty('--share', String(share));
    const name = make('button', 'link', shownName(reason));
    name.setAttribute('aria-label', `${shownName(reason)}: go to its next time`);
    name.addEventListener('click', () => this.seek(index));
    const row = make('tr', '', [
      make('td', '', [key, name, make('span', 'meaning', REASONS[reason].says)]),
      make('td', 'number', `${(ticks * this.run.info.robot.period).toFixed(1)} s`),
      make('td', 'number', `${(100 * share).toFixed(share < 0.0995 ? 1 : 0)} %`),
      make('td', 'wide', [bar]),
    ]);
    this.rows.set(reason, row);
    element('reason-rows').append(row);
  }

  /** The next tick at which this reason begins; after the last one, the first. */
  private seek(reason: number): void {
    const all = this.run.column('reason');
    const begins = (tick: number) => all[tick] === reason && (tick === 0 || all[tick - 1] !== reason);
    for (let i = 1; i <= all.length; ++i) {
      const tick = (this.player.tick + i) % all.length;
      if (!begins(tick)) continue;
      this.player.seek(tick);
      return;
    }
  }
}
