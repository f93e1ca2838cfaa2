// What the pictures of the pages were drawn from: a hash over the pages' sources.
import {createHash} from 'node:crypto';
import {readdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {fileURLToPath} from 'node:url';

const SOURCES = fileURLToPath(new URL('src', import.meta.url));

/** Written beside the pictures by figures.mjs. */
export const RECORD = fileURLToPath(new URL('../../../docs/figures/pages.sha256', import.meta.url));

function filesIn(folder) {
  const entries = readdirSync(folder, {withFileTypes: true}).sort((a, b) => (a.name < b.name ? -1 : 1));
  return entries.flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? filesIn(path) : [path];
  });
}

export function sourcesHash(folder = SOURCES) {
  const hash = createHash('sha256');
  for (const path of filesIn(folder)) {
    hash
      .update(`${path.slice(folder.length)}\0`)
      .update(readFileSync(path))
      .update('\0');
  }
  return hash.digest('hex');
}
