/** A response table from a file of `whisker rules table`. */
import type {Core} from './core.ts';

export interface OpenedTable {
  name: string;
  hash: string;
  /** A mirrored world gives the mirrored drive. */
  symmetric: boolean;
}

/** What is wrong with a file. */
export class TableError extends Error {}

const FORMAT = 1;
const MOST_CHARACTERS = 500_000;
const LONGEST_NAME = 100;

function demand(good: boolean, words: string): asserts good {
  if (!good) throw new TableError(words);
}

function parsed(text: string): Record<string, unknown> {
  demand(text.length <= MOST_CHARACTERS, 'it is too large for a table');
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch {
    throw new TableError('it is not JSON, or not all of it');
  }
  const file = Object(value) as Record<string, unknown>;
  demand('whisker_table' in file, 'it is not from whisker rules table');
  demand(file.whisker_table === FORMAT, `this page reads format ${FORMAT} only`);
  return file;
}

/** One line: it becomes part of a comment in C++. */
function oneLine(text: string): string {
  return text
    .replace(/[\s\p{C}]+/gu, ' ')
    .trim()
    .slice(0, LONGEST_NAME);
}

function isSymmetric(nodes: number[], columns: number): boolean {
  return nodes.every((x, i) => {
    const [node, output] = [i >> 1, i & 1];
    const r = node % columns;
    const mirrored = nodes[2 * (node - r + columns - 1 - r) + output];
    return output === 0 ? x + mirrored === 0 : x === mirrored;
  });
}

/** The table of the core becomes that of the file; unchanged if it throws TableError. */
export function openTable(core: Core, text: string): OpenedTable {
  const {name, hash, rows, columns, nodes} = parsed(text);
  demand(typeof name === 'string' && oneLine(name) !== '', 'it has no name');
  demand(typeof hash === 'string' && /^[0-9a-f]{8}$/.test(hash), 'its hash is not valid');
  const own = core.table();
  const size = `${own.rows} × ${own.columns}`;
  demand(rows === own.rows && columns === own.columns, `the table of the core has ${size} nodes`);
  demand(Array.isArray(nodes) && nodes.every((x) => typeof x === 'number'), 'its nodes are not numbers');
  const done = core.setTable(nodes, parseInt(hash, 16));
  demand(done !== 'none', `its nodes are not ${own.nodes.length} whole numbers from -32767 to 32767`);
  demand(done !== 'damaged', 'its nodes do not have its hash');
  return {name: oneLine(name), hash, symmetric: isSymmetric(nodes, own.columns)};
}
