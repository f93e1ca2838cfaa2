/** A campaign: the outcomes of its missions, and the missions to replay. */
import {copied} from './address.ts';
import type {Estimate, PageData} from './data.ts';
import {element, make, setText} from './dom.ts';
import {histogram} from './histogram.ts';
import {isGood, type Mission} from './mission.ts';
import {Scatter} from './scatter.ts';
import type {Theme} from './theme.ts';
import {ending, metres, shownName} from './words.ts';

function missions({fields, rows}: NonNullable<PageData['campaign']>): Mission[] {
  return rows.map(
    (row) => Object.fromEntries(fields.map((field, i) => [field, row[i]])) as unknown as Mission,
  );
}

function percent(share: number): string {
  return `${(100 * share).toFixed(1)} %`;
}

const SHARES: [key: string, words: string][] = [
  ['truly_there', 'truly there'],
  ['success', 'right by its own estimate'],
  ['reached', 'says it is there'],
  ['off_goal', 'says so and is not'],
  ['unreachable', 'unreachable'],
  ['gave_up', 'gave up'],
  ['contact', 'contact'],
  ['fault', 'fault'],
];

const SHOWN_AT_FIRST = 20;

function replayLink({seed}: Mission, replay: number): HTMLElement {
  const link = make('a', '', `seed ${seed}`) as HTMLAnchorElement;
  link.href = `#run=${replay}`;
  return link;
}

/** For a mission that is not in the page. */
function copyButton({seed}: Mission, command: string): HTMLElement {
  const button = make('button', 'link', `seed ${seed}: copy command`);
  button.title = command;
  button.addEventListener('click', async () => {
    button.textContent = `seed ${seed}: ${(await copied(command)) ? 'copied' : command}`;
  });
  return button;
}

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
    const planners = (summary.planners as string[]).map(shownName).join(', ');
    const title = `${summary.missions} missions: ${worlds}`;
    document.title = `${title} - Whisker`;
    setText('campaign-title', title);
    setText(
      'campaign-about',
      `Planner ${planners}, seeds ${summary.least_seed} to ${summary.greatest_seed}. ` +
        'Shares have 95 % bounds.',
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
    const reached = this.missions.filter(({outcome}) => ['reached', 'off_goal'].includes(outcome));
    const numbers = (of: (m: Mission) => number | null) =>
      reached.map(of).filter((x): x is number => x !== null && x < 1000);
    element('histograms').replaceChildren(
      histogram({
        title: 'path driven / shortest path',
        unit: '',
        values: numbers((m) => m.ratio),
        from: 1,
        tail: 0.95,
      }),
      histogram({
        title: 'time per metre of the shortest path',
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
    const {order, commands} = this.data.campaign!;
    const replayed = new Map(this.data.runs.map(({row}, i) => [row!, i]));
    const show = (most: number) => {
      element('replays').replaceChildren(
        ...order.slice(0, most).map((row, i) => this.row(i, row, replayed.get(row), commands[row])),
      );
      element('replays-all').hidden = most >= order.length;
    };
    setText('replays-all', `Show all ${order.length}`);
    element('replays-all').addEventListener('click', () => show(order.length));
    const stored = this.data.runs.length;
    setText(
      'replays-note',
      stored < order.length
        ? `This page has room for ${stored} of ${order.length} missions, the worst first. The commands of the others drive them again.`
        : '',
    );
    show(SHOWN_AT_FIRST);
  }

  private row(i: number, row: number, replay: number | undefined, command: string | null): HTMLElement {
    const mission = this.missions[row];
    return make('tr', '', [
      make('td', 'number', String(i + 1)),
      make('td', '', [replay === undefined ? copyButton(mission, command!) : replayLink(mission, replay)]),
      make('td', isGood(mission) ? '' : 'bad', ending(mission)),
      make('td', 'number', `${mission.time_s.toFixed(1)} s`),
      make('td', 'number', metres(mission.path_m)),
      make('td', 'number', mission.ratio === null ? '' : mission.ratio.toFixed(2)),
      make('td', 'number', mission.clearance < 1000 ? metres(mission.clearance, 3) : ''),
    ]);
  }
}
