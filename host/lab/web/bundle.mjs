// What the pages are bundled with: build.mjs and playground.mjs.
import {readFile} from 'node:fs/promises';
import {build} from 'esbuild-wasm';

export const here = (path) => new URL(path, import.meta.url);
// Dark colours are written once; the system's choice and the reader's button both use them.
const DARK = /:root\[data-theme='dark'\] \{([^}]*)\}/;

const BLOCKS =
  'html|head|meta|title|link|body|header|main|section|div|h1|h2|h3|p|nav|dl|dt|dd|ul|li|table|thead|tbody|tr|th|td|' +
  'figure|figcaption|dialog|noscript|script|style|form|fieldset|details|summary';

export async function bundled(options) {
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

async function style(sheets) {
  const texts = await Promise.all(sheets.map((sheet) => readFile(here(`src/${sheet}`), 'utf8')));
  const own = texts.join('\n');
  const dark = own.match(DARK)[1];
  const contents = `${own}
    @media (prefers-color-scheme: dark) {:root:not([data-theme='light']) {${dark}}}`;
  const text = await bundled({stdin: {contents, loader: 'css'}});
  return text.replace(/(--[\w-]+:) /g, '$1');
}

/**
 * Without the line ends beside elements that begin lines of their own, others become blanks; and without the slashes,
 * quotes and end tags that HTML does not need.
 */
function compact(html) {
  return html
    .replace(/\s*\n\s*/g, '\n')
    .replace(/(<(?:meta|link|input|br|hr|img)\b[^>]*?)\s*\/>/g, '$1>')
    .replace(/<(?!meta)\w[^<>]*/g, (tag) => tag.replace(/="([\w-]+)"(?=\s|$)/g, '=$1'))
    .replace(new RegExp(`(</?(?:${BLOCKS})\\b[^>]*>)\n`, 'g'), '$1')
    .replace(new RegExp(`\n(?=</?(?:${BLOCKS})\\b)`, 'g'), '')
    .replaceAll('\n', ' ')
    .replace(/<\/(?:dt|dd|li)>(?=<(?:dt|dd|li)\b|<\/(?:div|dl|ul)>)/g, '')
    .replace('</head><body>', '<body>')
    .replace(/<\/p>(?=<(?:div|dl|h[123]|p|section|table|ul)\b|<\/(?:dialog|div|section)>)/g, '')
    .concat('\n');
}

/**
 * The page of src/HTML with everything in its place: its style sheets, its script and what else it asks for. It begins with the
 * notices of what others wrote.
 */
export async function bundledPage({html, sheets, entry, notices = [], more = {}}) {
  const [text, css, script, ...kept] = await Promise.all([
    readFile(here(`src/${html}`), 'utf8'),
    style(sheets),
    bundled({entryPoints: [here(`src/${entry}`).pathname], format: 'iife'}),
    ...notices.map((notice) => readFile(here(notice), 'utf8')),
  ]);
  if (/<\/(script|style)/i.test(css + script)) throw new Error('the bundle would end its own element');
  const parts = {style: css, script, ...more};
  // Functions: a replacement string would give $ a meaning.
  const page = Object.entries(parts).reduce(
    (whole, [name, part]) => whole.replace(`<!--${name}-->`, () => part),
    compact(text),
  );
  const notice = kept
    .map((licence, i) => `<!--\n${notices[i].split('/')[1]}: ${licence.trim()}\n-->\n`)
    .join('');
  const whole = page.replace(/^<!doctype html>\n?/i, (doctype) => doctype + notice);
  const notAscii = whole.match(/[^\x00-\x7f]/);
  if (notAscii) throw new Error(`not ASCII: ${notAscii[0]}`);
  return whole;
}
