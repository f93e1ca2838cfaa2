// Builds host/lab/page/template.html, the page without its data. usage: node build.mjs [--check]
// --check writes nothing, and fails if the committed file is not what the sources give or is too large.
import {readFile, writeFile} from 'node:fs/promises';
import {bundledPage} from './bundle.mjs';

const MOST_BYTES = 160_000;
const here = (path) => new URL(path, import.meta.url);
const TEMPLATE = here('../page/template.html');

const page = await bundledPage({
  html: 'index.html',
  sheets: ['../node_modules/uplot/dist/uPlot.min.css', 'style.css'],
  entry: 'main.ts',
  notices: ['node_modules/uplot/LICENSE'],
});
if (page.length > MOST_BYTES) throw new Error(`${page.length} bytes; at most ${MOST_BYTES}`);
if (process.argv.includes('--check')) {
  if ((await readFile(TEMPLATE, 'utf8')) !== page) {
    console.error(
      'host/lab/page/template.html is not what host/lab/web builds: run npm run build in host/lab/web',
    );
    process.exit(1);
  }
} else {
  await writeFile(TEMPLATE, page);
}
console.log(`template.html: ${page.length} bytes of at most ${MOST_BYTES}`);
