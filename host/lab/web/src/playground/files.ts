/** Copies the link, and saves the scenario and the table. */
import {copied, linkWith} from '../address.ts';
import {element, setText} from '../dom.ts';
import type {Core} from './core.ts';
import {tableHeader} from './header.ts';
import type {Driver} from './driver.ts';
import type {Playground} from './playground.ts';
import {hashOf} from './share.ts';
import {scenarioToml} from './toml.ts';

function save(name: string, text: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], {type: 'text/plain'}));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

/** What the table is of; null: the default rules. */
function noteOf({state, opened}: Playground): string | null {
  if (opened) return `Opened in the playground: ${opened.name}, hash ${opened.hash}.`;
  return state.rules && `Of rules edited in the playground: ${state.rules}`;
}

export function offerFiles(play: Playground, core: Core, driver: Driver): void {
  element('save-scenario').addEventListener('click', () => {
    const {kind, seed, own} = play.state;
    save(
      `${kind}-${seed}${own ? '-changed' : ''}.toml`,
      scenarioToml(play.name, play.situation, play.drivenByUser ? driver.parameters() : []),
    );
  });
  element('save-drive').addEventListener('click', () => save('drive.csv', driver.csv()));
  element('save-table').addEventListener('click', () => {
    save('response_table.hpp', tableHeader(core.table(), noteOf(play)));
  });
  element('copy').addEventListener('click', async () => {
    const done = await copied(linkWith(await hashOf(play.state)));
    setText(
      'copied',
      done ? `Link copied${play.opened ? ', without the table' : ''}` : 'The address bar has the link',
    );
  });
}
