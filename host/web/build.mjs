// Builds host/page/template.html, the page without its data. usage: node build.mjs [--check]
// --check writes nothing, and fails if the committed file is not what the sources give or is too large.
import {readFile, writeFile} from 'node:fs/promises';
import {build} from 'esbuild';

const MOST_BYTES = 150_000;
const here = (path) => new URL(path, import.meta.url);
const TEMPLATE = here('../page/template.html');
// Dark colours are written once; the system's choice and the reader's button both use them.
const DARK = /:root\[data-theme='dark'\] \{([^}]*)\}/;

async function bundled(options) {
  const result = await build({
    bundle: true,
    minify: true,
    write: false,
    charset: 'ascii',
    legalComments: 'none',
    target: ['chrome103', 'firefox113', 'safari16.4'],
    ...options,
  });
  return result.outputFiles[0].text.trim();
}

async function style() {
  const own = await readFile(here('src/style.css'), 'utf8');
  const dark = own.match(DARK)[1];
  const plots = await readFile(here('node_modules/uplot/dist/uPlot.min.css'), 'utf8');
  const contents = `${plots}${own}
    @media (prefers-color-scheme: dark) {:root:not([data-theme='light']) {${dark}}}`;
  return bundled({stdin: {contents, loader: 'css'}});
}

async function template() {
  const [html, css, script] = await Promise.all([
    readFile(here('src/index.html'), 'utf8'),
    style(),
    bundled({entryPoints: [here('src/main.ts').pathname], format: 'iife'}),
  ]);
  if (/<\/(script|style)/i.test(css + script)) throw new Error('the bundle would end its own element');
  // Functions: a replacement string would give $ a meaning.
  return html
    .replace(/\n\s*/g, '\n')
    .replace('<!--style-->', () => css)
    .replace('<!--script-->', () => script);
}

const page = await template();
const notAscii = page.match(/[^\x00-\x7f]/);
if (notAscii) throw new Error(`not ASCII: ${notAscii[0]}`);
if (page.length > MOST_BYTES) throw new Error(`${page.length} bytes; at most ${MOST_BYTES}`);
if (process.argv.includes('--check')) {
  if ((await readFile(TEMPLATE, 'utf8')) !== page) {
    console.error('host/page/template.html is not what host/web builds: run npm run build in host/web');
    process.exit(1);
  }
} else {
  await writeFile(TEMPLATE, page);
}
console.log(`template.html: ${page.length} bytes of at most ${MOST_BYTES}`);
