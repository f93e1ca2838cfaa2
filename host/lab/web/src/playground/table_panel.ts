/** Opens a table from a file, and shows it in the place of the 25 rules. */
import {element, setText} from '../dom.ts';
import type {Core} from './core.ts';
import {openTable, TableError, type OpenedTable} from './opened_table.ts';

export class TablePanel {
  /** Null: the 25 rules make the table. */
  opened: OpenedTable | null = null;

  constructor(
    private readonly core: Core,
    private readonly changed: () => void,
  ) {
    const input = element<HTMLInputElement>('table-file');
    element('table-open').addEventListener('click', () => input.click());
    input.addEventListener('change', () => {
      const file = input.files?.[0];
      if (file) void this.read(file);
    });
    // Else, the same file could not be opened again.
    input.addEventListener('click', () => (input.value = ''));
  }

  /** The 25 rules make the table again. */
  close(): void {
    this.opened = null;
    this.show();
  }

  private async read(file: File): Promise<void> {
    // A fault that stays the same is told again.
    this.say('');
    try {
      this.opened = openTable(this.core, await file.text());
    } catch (error) {
      const why = error instanceof TableError ? error.message : 'the browser cannot read it';
      this.say(`${file.name} could not be opened: ${why}.`);
      return;
    }
    this.show();
    this.changed();
  }

  private say(fault: string): void {
    element('table-fault').hidden = fault === '';
    setText('table-fault', fault);
  }

  private show(): void {
    const {opened} = this;
    this.say('');
    const shown = opened ? 'opened' : 'rules';
    for (const part of document.querySelectorAll<HTMLElement>('[data-table]')) {
      part.hidden = part.dataset.table !== shown;
    }
    setText('table-opened', opened ? `${opened.name}, hash ${opened.hash}: ${symmetry(opened)}` : '');
  }
}

function symmetry({symmetric}: OpenedTable): string {
  return symmetric
    ? 'symmetric.'
    : 'not symmetric: in a mirrored world the robot would not drive the mirrored path.';
}
