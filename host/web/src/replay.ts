/** One run on the page: everything that shows it. */
import {CloseUp} from './closeup.ts';
import type {Run} from './data.ts';
import {Facts} from './facts.ts';
import {placeOf, show} from './link.ts';
import {Player} from './player.ts';
import {distanceToGoal, nearestSoFar, Plots} from './plots.ts';
import {ProgressPanel} from './progress.ts';
import {ResponsePanel} from './response.ts';
import {Scenery} from './scenery.ts';
import type {Theme} from './theme.ts';
import {Timeline} from './timeline.ts';
import {Transport} from './transport.ts';
import {WorldView} from './world.ts';

/** `index` is the run's number in the address; null where there is only one. */
export function openReplay(run: Run, index: number | null, theme: Theme): Player {
  const player = new Player(run);
  const distance = distanceToGoal(run);
  const nearest = nearestSoFar(run, distance);
  const scenery = new Scenery(run);
  const world = new WorldView(run, player, theme, scenery);
  const closeUp = new CloseUp(run, player, theme, scenery);
  const timeline = new Timeline(run, player, theme);
  const response = new ResponsePanel(run, player, theme);
  const plots = new Plots(run, player, theme, distance, nearest);
  const progress = new ProgressPanel(run, player, distance, nearest);
  const facts = new Facts(run, player, theme, distance);
  const transport = new Transport(run, player, timeline, world, theme);

  const update = () => {
    world.draw();
    closeUp.draw();
    for (const part of [timeline, response, plots, progress, facts, transport]) part.update();
    if (!player.playing) show({run: index, time: run.t[player.tick]});
  };
  player.onChange(update);
  theme.onChange(() => {
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
  followAddress();
  player.request();
  return player;
}
