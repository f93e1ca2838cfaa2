/** A live run: shows the events of its server as they arrive. */
import {bytesOfBase64, decodeColumns, inflated, type ColumnInfo} from './columns.ts';
import {Run, type Edge, type PageData, type Result, type RunInfo, type Setting} from './data.ts';
import {element, setText} from './dom.ts';
import {openReplay, type Replay} from './replay.ts';
import type {Theme} from './theme.ts';

/** An event, as host/lab/view/feed.hpp writes it. */
interface News {
  run: string;
  /** The tick that the columns begin with. */
  from: number;
  says: string;
  ended: boolean;
  result: Result | null;
  edges: Edge[];
  columns: ColumnInfo[];
  data: string;
  setting?: Setting;
}

const AGAIN_MS = 2000;

type State = 'connecting' | 'live' | 'ended';

export class Live {
  state: State = 'connecting';
  private name = '';
  private setting: Setting | null = null;
  private replay: Replay | null = null;
  private source: EventSource | null = null;
  /** Events are unpacked one after the other. */
  private last = Promise.resolve();

  constructor(
    private readonly data: PageData,
    private readonly theme: Theme,
    private readonly shown: (run: Run, replay: Replay) => void,
    private readonly failed: (error: unknown) => void,
  ) {
    element('live').hidden = false;
    this.tell('connecting', '');
    this.connect();
  }

  private connect(): void {
    const source = new EventSource(this.data.live!);
    this.source = source;
    source.onmessage = ({data}) => {
      const news = JSON.parse(data as string) as News;
      if (news.ended) source.close();
      this.then(() => this.take(news));
    };
    source.onerror = () => {
      const closed = source.readyState === EventSource.CLOSED;
      this.then(async () => this.lost(closed ? await this.refusal() : ''));
      if (closed) setTimeout(() => this.connect(), AGAIN_MS);
    };
  }

  private then(next: () => void | Promise<void>): void {
    this.last = this.last.then(next).catch(this.failed);
  }

  /** The reason for the refusal, which a browser does not pass to the listener of events. */
  private async refusal(): Promise<string> {
    const stop = new AbortController();
    try {
      const answer = await fetch(this.data.live!, {signal: stop.signal});
      return answer.ok ? '' : (await answer.text()).trim();
    } catch {
      return '';
    } finally {
      stop.abort();
    }
  }

  private lost(refusal: string): void {
    if (this.state === 'ended') return;
    this.tell('connecting', refusal || 'no answer; the run may be over');
  }

  private async take(news: News): Promise<void> {
    const ticks = this.replay?.run.ticks ?? 0;
    const another = this.name !== '' && news.run !== this.name;
    // The parts of the page keep a reference to their run, so another run needs a reload.
    if (another || (news.from !== ticks && news.from !== 0)) {
      this.source?.close();
      location.reload();
      return;
    }
    this.name = news.run;
    this.setting ??= news.setting!;
    const columns = decodeColumns(await inflated(bytesOfBase64(news.data)), news.columns);
    if (this.replay) this.replay.grow(columns, news.edges, news.from);
    else if (columns.get('t_s')!.length > 0) this.open(this.setting, news, columns);
    else setText('live-name', this.setting.name);
    if (news.ended) this.end(news.result);
    else this.tell('live', news.says);
  }

  private open(setting: Setting, {edges}: News, columns: Map<string, Float64Array>): void {
    setText('live-name', '');
    const info: RunInfo = {...setting, result: null, edges, columns: []};
    const run = new Run(info, this.data.shared, columns);
    this.replay = openReplay(run, null, this.theme, true);
    this.shown(run, this.replay);
  }

  private end(result: Result | null): void {
    this.tell('ended', result ? '' : 'the run was interrupted');
    this.replay?.end(result);
  }

  private tell(state: State, words: string): void {
    this.state = state;
    element('live').dataset.state = state;
    setText('live-state', state);
    setText('live-says', words);
  }
}
