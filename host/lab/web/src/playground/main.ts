import {CloseUp} from '../closeup.ts';
import {Address, sayLinkFault} from '../address.ts';
import {element, setText} from '../dom.ts';
import {ResponsePanel} from '../response.ts';
import {firedRules} from '../rules.ts';
import {asksOfNow, usesTable} from '../table_use.ts';
import {Theme} from '../theme.ts';
import {showCard, showLedger, showProgress} from './cards.ts';
import {Controls} from './controls.ts';
import {answersOf, controllerOf, refreshController} from './controller.ts';
import {Core} from './core.ts';
import {DriveBar} from './drive_bar.ts';
import {Driver, MOST_TURNING} from './driver.ts';
import {offerFiles} from './files.ts';
import {notesOf} from './native.ts';
import {NO_NOISE, NoisePanel} from './noise_panel.ts';
import {unpacked} from './packed.ts';
import {Chip} from './pico.ts';
import {Playground} from './playground.ts';
import {RulesPanel} from './rules_panel.ts';
import {hashOf, stateOf, type State} from './share.ts';
import {Stage} from './stage.ts';
import {TablePanel} from './table_panel.ts';

const FIRST: State = {kind: 'u-trap', seed: 7, who: 'skirt-map', own: null, noise: NO_NOISE, rules: null};

/** Milliseconds. */
const PANELS_EVERY = 80;

const NO_SUCH_WORLD = 'its world is not valid, or too large for this page';

async function open(): Promise<void> {
  const theme = new Theme();
  const core = await Core.load(await unpacked(element('module').textContent ?? ''));
  const first = await stateOf(location.hash, core.words, FIRST);
  const answers = answersOf(core.rules());
  const controller = controllerOf(core, answers);
  const driver = new Driver(core.robot);
  const chip = new Chip(core);
  let play: Playground;
  sayLinkFault(first.fault);
  try {
    play = new Playground(core, first.state, driver, chip);
  } catch {
    sayLinkFault(NO_SUCH_WORLD);
    play = new Playground(core, FIRST, driver, chip);
  }
  document.body.dataset.view = 'playground';
  element('playground').hidden = false;

  const stage = new Stage(play, theme);
  const focus = () => play.runs[stage.focus] ?? play.runs[0];
  const closeUp = new CloseUp(focus(), {tick: 0}, theme, stage.scenery());
  const response = new ResponsePanel(focus(), {tick: 0}, theme, controller);
  const noise = new NoisePanel((values) => play.setNoise(values));
  const follow = () => {
    const {opened} = table;
    const code = opened ? null : rules.code;
    refreshController(controller, core, answers, opened !== null);
    response.restyle();
    play.setRules(code, opened);
  };
  const table = new TablePanel(core, follow);
  const rules = new RulesPanel(core, theme, () => {
    table.close();
    follow();
  });
  // Before the controls: the keys of a driver come first.
  const most = {forward: core.robot.max_speed, turning: MOST_TURNING};
  const bar = new DriveBar(play, driver, core.words.reasons, most);
  const controls = new Controls(play, stage, core.words.kinds);
  offerFiles(play, core, driver);

  const address = new Address(() => hashOf(play.state));
  let panels = 0;
  const draw = (now: number) => {
    stage.draw();
    play.runs.forEach((run, i) => showCard(stage.cards[i], run, theme));
    controls.update();
    bar.update();
    // During a run, the panels need fewer updates than the views.
    if (play.playing && now - panels < PANELS_EVERY) return;
    panels = now;
    closeUp.run = response.run = focus();
    closeUp.scenery = stage.scenery();
    closeUp.commands = focus().arcs;
    closeUp.draw();
    response.update();
    const at = (name: string) => focus().column(name)[0];
    const speak = usesTable(focus(), 0) && asksOfNow(focus(), 0);
    rules.light(speak ? firedRules(controller, at('d'), at('r')) : []);
    showProgress(focus(), play.runs.length > 1);
    showLedger(play.runs, notesOf(play));
  };
  let last = 0;
  let pending = false;
  const request = () => {
    if (pending) return;
    pending = true;
    requestAnimationFrame((now) => {
      pending = false;
      // A hidden page gets no frames; it continues from the same tick.
      if (play.playing) play.pass(Math.min(0.1, Math.max(0, (now - last) / 1000)));
      last = now;
      draw(now);
      if (play.playing) request();
    });
  };
  play.onChange(() => {
    request();
    address.change();
  });
  stage.onChange(request);
  chip.onTold = () => {
    for (const run of play.runs) run.refresh();
    request();
  };
  theme.onChange(() => {
    response.restyle();
    request();
  });
  addEventListener('hashchange', async () => {
    const {state, fault} = await stateOf(location.hash, core.words, FIRST);
    sayLinkFault(fault);
    if (fault) return;
    if (!play.restore(state)) {
      sayLinkFault(NO_SUCH_WORLD);
      return;
    }
    stage.fit();
    rules.setCode(state.rules);
    noise.show(state.noise);
  });
  noise.show(play.state.noise);
  if (play.state.rules) rules.setCode(play.state.rules);
  play.begin();
  // For tests, measurements and the console.
  Object.assign(window, {whisker: {play, core, stage, driver, chip}});
  play.playing = !matchMedia('(prefers-reduced-motion: reduce)').matches;
  last = performance.now();
  request();
}

open().catch((error: unknown) => {
  document.body.dataset.view = 'error';
  element('error').hidden = false;
  setText('error-text', error instanceof Error ? error.message : String(error));
});
