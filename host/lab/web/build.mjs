// Builds the pages without their data, which whisker embeds. usage: node build.mjs [--check]
// --check writes nothing, and fails if a committed file is not what the sources give or is too large.
import {readFile, writeFile} from 'node:fs/promises';
import {bundledPage} from './bundle.mjs';

const PAGES = [
  {
    file: 'page/template.html',
    most: 160_000,
    html: 'index.html',
    sheets: ['../node_modules/uplot/dist/uPlot.min.css', 'style.css'],
    entry: 'main.ts',
    notices: ['node_modules/uplot/LICENSE'],
  },
  {
    file: 'rules/page.html',
    most: 30_000,
    html: 'rule_base.html',
    sheets: ['style.css', 'rule_base.css'],
    entry: 'rule_base.ts',
  },
];

for (const {file, most, ...parts} of PAGES) {
  const path = new URL(`../${file}`, import.meta.url);
  const page = await bundledPage(parts);
  if (page.length > most) throw new Error(`${file}: ${page.length} bytes; at most ${most}`);
  if (!process.argv.includes('--check')) {
    await writeFile(path, page);
  } else if ((await readFile(path, 'utf8')) !== page) {
    console.error(`host/lab/${file} is not what host/lab/web builds: run npm run build in host/lab/web`);
    process.exitCode = 1;
  }
  console.log(`${file}: ${page.length} bytes of at most ${most}`);
}
