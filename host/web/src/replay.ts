/** The view of one run: all parts of the page that show it. */
import {Address} from './address.ts';
import {CloseUp} from './closeup.ts';
import type {Edge, Result, Run} from './data.ts';
import {Facts} from './facts.ts';
import {WayToGoal} from './goal.ts';
import {hashOf, placeOf} from './link.ts';
import {Player} from './player.ts';
import {Plots} from './plots.ts';
import {ProgressPanel} from './progress.ts';
import {ResponsePanel} from './response.ts';
import {Scenery} from './scenery.ts';
import type {Theme} from './theme.ts';
import {Timeline} from './timeline.ts';
import {Transport} from './transport.ts';
import {WorldView} from './world.ts';

/** Milliseconds between two redraws of the plots of a live run. */
const PLOTS_EVERY = 250;

export interface Replay {
  readonly run: Run;
  readonly player: Player;
  /** Adds ticks, as Run.grow does, and sets all boundaries so far. */
  grow(columns: Map<string, Float64Array>, edges: Edge[], from: number): void;
  /** No more ticks follow. */
  end(result: Result | null): void;
}

/** `index` is the run's number in the address; null if there is only one. `live`: more ticks follow. */
export function openReplay(run: Run, index: number | null, theme: Theme, live = false): Replay {
  const player = new Player(run);
  player.live = live;
  const way = new WayToGoal(run);
  const scenery = new Scenery(run);
  const world = new WorldView(run, player, theme, scenery);
  const closeUp = new CloseUp(run, player, theme, scenery);
  const timeline = new Timeline(run, player, theme);
  const response = new ResponsePanel(run, player, theme);
  const plots = new Plots(run, player, theme, way);
  const progress = new ProgressPanel(run, player, way);
  const facts = new Facts(run, player, theme, way);
  const hash = () => hashOf({run: index, time: player.following ? null : run.t[player.tick]});
  const transport = new Transport(run, player, timeline, world, theme, hash);
  const address = new Address(hash);

  // Once a frame, however many events arrive between two frames.
  let grown = false;
  const catchUp = () => {
    if (!grown) return;
    grown = false;
    for (const part of [way, world, timeline, progress, plots]) part.grow();
  };
  const update = () => {
    catchUp();
    world.draw();
    closeUp.draw();
    for (const part of [timeline, response, plots, progress, facts, transport]) part.update();
    if (!player.playing) address.change();
  };
  player.onChange(update);
  theme.onChange(() => {
    catchUp();
    timeline.draw();
    response.restyle();
    plots.restyle();
    update();
  });
  const followAddress = () => {
    const {time} = placeOf(location.hash);
    if (time !== null && player.run.tickAt(time) !== player.tick) player.seekTime(time);
  };
  addEventListener('hashchange', followAddress);
  if (live) player.seek(player.end);
  followAddress();
  player.request();
  let plotsWait = false;
  const drawPlots = () => {
    plotsWait = false;
    catchUp();
    plots.redraw();
  };
  return {
    run,
    player,
    grow(columns, edges, from) {
      run.grow(columns, from);
      run.info.edges = edges;
      grown = true;
      if (!plotsWait) setTimeout(drawPlots, PLOTS_EVERY);
      plotsWait = true;
      player.grow();
    },
    end(result) {
      run.info.result = result;
      facts.end();
      timeline.end();
      player.stopLive();
    },
  };
}
