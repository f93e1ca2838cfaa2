/** A campaign: what came of its missions, and the worst of them to replay. */
import type {Estimate, PageData} from './data.ts';
import {element, make, setText} from './dom.ts';
import {histogram} from './histogram.ts';
import {Scatter} from './scatter.ts';
import type {Theme} from './theme.ts';
import {metres} from './words.ts';

export interface Mission {
  seed: number;
  outcome: string;
  success: boolean;
  time_s: number;
  path_m: number;
  shortest_m: number | null;
  ratio: number | null;
  s_per_m: number | null;
  clearance: number;
  estimate_error: number;
  detail: string;
}

function missions({fields, rows}: NonNullable<PageData['campaign']>): Mission[] {
  return rows.map(
    (row) => Object.fromEntries(fields.map((field, i) => [field, row[i]])) as unknown as Mission,
  );
}

function percent(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}

const SHARES: [key: string, words: string][] = [
  ['success', 'right verdict'],
  ['reached', 'reached'],
  ['unreachable', 'unreachable'],
  ['gave_up', 'gave up'],
  ['contact', 'contact'],
  ['fault', 'fault'],
];

export class CampaignView {
  private readonly missions: Mission[];

  constructor(
    private readonly data: PageData,
    theme: Theme,
  ) {
    const campaign = data.campaign!;
    this.missions = missions(campaign);
    const {summary} = campaign;
    const worlds = (summary.worlds as string[]).join(', ');
    const planners = (summary.planners as string[]).join(', ');
    const title = `${summary.missions} missions: ${worlds}`;
    document.title = `${title} - Whisker`;
    setText('campaign-title', title);
    setText(
      'campaign-about',
      `Planner ${planners}, seeds ${summary.least_seed} to ${summary.greatest_seed}. ` +
        'Shares come with their 95 % bounds.',
    );
    this.shares(summary);
    const scatter = new Scatter(
      this.missions,
      data.runs.map(({row}) => row!),
      theme,
    );
    this.distributions();
    this.replays();
    theme.onChange(() => scatter.draw());
  }

  private shares(summary: Record<string, unknown>): void {
    const rows = SHARES.map(([key, words]) => {
      const {value, low, high} = summary[key] as Estimate;
      const count = Math.round(value * this.missions.length);
      const bar = make('span', `bar ${key}`);
      bar.style.setProperty('--share', String(value));
      return make('tr', '', [
        make('th', '', words),
        make('td', 'number', String(count)),
        make('td', 'number', percent(value)),
        make(
          'td',
          'number muted',
          low === null || high === null ? '' : `${percent(low)} to ${percent(high)}`,
        ),
        make('td', 'wide', [bar]),
      ]);
    });
    for (const row of rows) row.firstElementChild!.setAttribute('scope', 'row');
    element('shares').replaceChildren(...rows);
  }

  private distributions(): void {
    const reached = this.missions.filter(({outcome}) => outcome === 'reached');
    const numbers = (of: (m: Mission) => number | null) =>
      reached.map(of).filter((x): x is number => x !== null && x < 1000);
    element('histograms').replaceChildren(
      histogram({
        title: 'way driven / shortest way',
        unit: '',
        values: numbers((m) => m.ratio),
        from: 1,
        tail: 0.95,
      }),
      histogram({
        title: 'time per metre of the shortest way',
        unit: 's/m',
        values: numbers((m) => m.s_per_m),
        from: 0,
        tail: 0.95,
      }),
      histogram({
        title: 'nearest to an obstacle',
        unit: 'm',
        values: numbers((m) => m.clearance),
        from: 0,
        tail: 0.05,
      }),
      histogram({
        title: 'error of its own position at the end',
        unit: 'm',
        values: numbers((m) => m.estimate_error),
        from: 0,
        tail: 0.95,
      }),
    );
  }

  private replays(): void {
    const rows = this.data.runs.map((run, i) => {
      const mission = this.missions[run.row!];
      const link = make('a', '', `seed ${mission.seed}`) as HTMLAnchorElement;
      link.href = `#run=${i}`;
      return make('tr', '', [
        make('td', 'number', String(i + 1)),
        make('td', '', [link]),
        make('td', mission.success ? '' : 'bad', mission.outcome.replaceAll('_', ' ')),
        make('td', 'number', `${mission.time_s.toFixed(1)} s`),
        make('td', 'number', metres(mission.path_m)),
        make('td', 'number', mission.ratio === null ? '' : mission.ratio.toFixed(2)),
        make('td', 'number', mission.clearance < 1000 ? metres(mission.clearance, 3) : ''),
      ]);
    });
    element('replays').replaceChildren(...rows);
  }
}
