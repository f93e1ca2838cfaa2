/** The view of one run: all parts of the page that show it. */
import {Address} from './address.ts';
import {CloseUp} from './closeup.ts';
import {CommandArcs} from './command_arcs.ts';
import {BEAMS, type Edge, type Result, type Run} from './data.ts';
import {Facts} from './facts.ts';
import {WayToGoal} from './goal.ts';
import {Grants} from './grants.ts';
import {GuardPanel, guardPlots} from './guard_panel.ts';
import {GuardStory} from './guard_story.ts';
import {hashOf, placeOf} from './link.ts';
import {MissionStory} from './mission_story.ts';
import {Player} from './player.ts';
import {goalPlot, Plots, type Plot} from './plots.ts';
import {ProgressPanel} from './progress.ts';
import {ResponsePanel} from './response.ts';
import {Scenery} from './scenery.ts';
import type {Story} from './story.ts';
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

/** What differs between a mission and a drive of the guard. */
interface Parts {
  story: Story;
  commands: CommandArcs | null;
  plots: Plot[];
  panels: {update(): void}[];
  growing: {grow(): void}[];
  restyle(): void;
}

function missionParts(run: Run, player: Player, theme: Theme, way: WayToGoal): Parts {
  const response = new ResponsePanel(run, player, theme, run.shared.controller!);
  const progress = new ProgressPanel(run, player, way);
  const story = new MissionStory(run);
  return {
    story,
    commands: null,
    plots: [goalPlot(run, way)],
    panels: [response, progress],
    growing: [story, progress],
    restyle: () => response.restyle(),
  };
}

function guardParts(run: Run, player: Player): Parts {
  const grants = new Grants(run);
  const commands = new CommandArcs(run, {
    asked: (tick) => grants.at(grants.asked, tick),
    granted: (tick) => (grants.info.guarded ? grants.at(grants.granted, tick) : null),
    colour: (tick) => grants.colour(tick),
  });
  return {
    story: new GuardStory(run, grants),
    commands,
    plots: guardPlots(grants),
    panels: [new GuardPanel(run, grants, player)],
    growing: [],
    restyle: () => undefined,
  };
}

/** The first tick at which all beams have been read; 0 if that never is. */
function firstSight(run: Run): number {
  const blind = (tick: number) => BEAMS.some((_, beam) => run.range(beam, tick) === null);
  let tick = 0;
  while (tick < run.ticks && blind(tick)) ++tick;
  return tick < run.ticks ? tick : 0;
}

/** `index` is the run's number in the address; null if there is only one. `live`: more ticks follow. */
export function openReplay(run: Run, index: number | null, theme: Theme, live = false): Replay {
  const player = new Player(run);
  player.live = live;
  const way = new WayToGoal(run);
  const scenery = new Scenery(run);
  const kind = run.info.guard ? guardParts(run, player) : missionParts(run, player, theme, way);
  const {story, commands} = kind;
  const facts = new Facts(run, player, theme, way, story);
  const world = new WorldView(run, player, theme, scenery, story.way, commands);
  const closeUp = new CloseUp(run, player, theme, scenery, commands);
  const timeline = new Timeline(run, player, theme, story);
  const plots = new Plots(run, player, theme, kind.plots);
  const hash = () => hashOf({run: index, time: player.following ? null : run.t[player.tick]});
  const transport = new Transport(run, player, timeline, world, theme, hash);
  const address = new Address(hash);

  // Once a frame, however many events arrive between two frames.
  let grown = false;
  const catchUp = () => {
    if (!grown) return;
    grown = false;
    for (const part of [way, world, timeline, ...kind.growing, plots]) part.grow();
  };
  const update = () => {
    catchUp();
    world.draw();
    closeUp.draw();
    for (const part of [timeline, plots, ...kind.panels, facts, transport]) part.update();
    if (!player.playing) address.change();
  };
  player.onChange(update);
  theme.onChange(() => {
    catchUp();
    timeline.draw();
    kind.restyle();
    plots.restyle();
    update();
  });
  const followAddress = () => {
    const {time} = placeOf(location.hash);
    if (time !== null && player.run.tickAt(time) !== player.tick) player.seekTime(time);
  };
  addEventListener('hashchange', followAddress);
  player.seek(live ? player.end : firstSight(run));
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
