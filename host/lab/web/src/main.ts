import {sayLinkFault} from './address.ts';
import {CampaignView} from './campaign.ts';
import {loadRun, pageData, type PageData, type Run} from './data.ts';
import {element, setText} from './dom.ts';
import {faultOf, placeOf} from './link.ts';
import {Live} from './live.ts';
import {openReplay, type Replay} from './replay.ts';
import {Theme} from './theme.ts';

function view(name: 'run' | 'campaign' | 'error' | 'waiting'): void {
  document.body.dataset.view = name;
  for (const id of ['run', 'campaign', 'error']) element(id).hidden = id !== name;
}

async function openRun(data: PageData, index: number, theme: Theme): Promise<void> {
  const run = await loadRun(data, index);
  view('run');
  element('to-campaign').hidden = !data.campaign;
  expose(run, openReplay(run, data.campaign ? index : null, theme));
}

/** For tests, measurements and the console. */
function expose(run: Run, {player}: Replay): void {
  Object.assign(window, {whisker: {run, player}});
}

function fail(error: unknown): void {
  view('error');
  setText('error-text', error instanceof Error ? error.message : String(error));
}

async function open(): Promise<void> {
  const data = pageData();
  const theme = new Theme();
  element<HTMLDialogElement>('keys').addEventListener('click', (event) => {
    (event.currentTarget as HTMLDialogElement).close();
  });
  for (const id of ['help', 'help-keys']) {
    element(id).addEventListener('click', () => element<HTMLDialogElement>('keys').showModal());
  }
  const {run} = placeOf(location.hash);
  const judge = () => {
    const fault = faultOf(location.hash, data.runs.length);
    sayLinkFault(fault);
    return fault;
  };
  const fault = judge();
  addEventListener('hashchange', judge);
  if (data.live) {
    view('waiting');
    const opened = (opened: Run, replay: Replay) => {
      view('run');
      expose(opened, replay);
    };
    new Live(data, theme, opened, fail);
  } else if (!data.campaign) {
    await openRun(data, 0, theme);
  } else if (run !== null && fault === '') {
    await openRun(data, run, theme);
  } else {
    view('campaign');
    new CampaignView(data, theme);
  }
  if (!data.campaign) return;
  // The parts of the page keep a reference to their run, so another run needs a reload.
  addEventListener('hashchange', () => {
    if (placeOf(location.hash).run !== run) location.reload();
  });
}

open().catch(fail);
