/** The whole state of the page in its address. */
import {unknownPart} from '../address.ts';
import {bytesOfBase64, inflatedUpTo} from '../columns.ts';
import {YOU} from './driver.ts';
import {PICO} from './pico.ts';
import {flat, situationOf, type Situation} from './situation.ts';

/** By name: each planner alone, some pairs side by side, the user, and the Pico. */
export type Teams = Record<string, readonly string[]>;
export function teamsOf(planners: string[]): Teams {
  const alone = Object.fromEntries(planners.map((planner) => [planner, [planner]]));
  return {...alone, both: ['skirt', 'thesis'], 'skirt-map': ['skirt', 'map'], [YOU]: [YOU], [PICO]: [PICO]};
}

export interface State {
  kind: string;
  seed: number;
  /** A name of Teams. */
  who: string;
  /** The world with the changes of the user; null while it is that of the generator. */
  own: Situation | null;
  /** As in Situation. */
  noise: number[];
  /** 50 digits, the terms of the 25 turns and of the 25 steps; null for the default rules. */
  rules: string | null;
}

async function deflated(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new CompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function base64(bytes: Uint8Array): string {
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''))
    .replaceAll('+', '-')
    .replaceAll('/', '_')
    .replace(/=+$/, '');
}

export async function hashOf(state: State): Promise<string> {
  const params = new URLSearchParams({world: state.kind, seed: String(state.seed), planner: state.who});
  if (state.noise.some((x) => x > 0)) params.set('noise', state.noise.join('_'));
  if (state.rules) params.set('rules', state.rules);
  if (state.own) {
    const text = JSON.stringify(flat(state.own));
    params.set('own', base64(await deflated(new TextEncoder().encode(text))));
  }
  return `#${params}`;
}

/** The page refuses a link with more characters, or with more bytes when unpacked. */
const MOST_CHARACTERS = 200_000;
const MOST_BYTES = 500_000;

/** The reason why a link is refused. */
class LinkError extends Error {}

function noiseOf(text: string): number[] {
  const list = text.split('_').map(Number);
  if (list.length === 5 && list.every((x) => x >= 0 && Number.isFinite(x))) return list;
  throw new LinkError('its noise is not valid');
}

async function ownOf(text: string): Promise<Situation> {
  if (text.length > MOST_CHARACTERS) throw new LinkError('its world is too large for this page');
  let bytes: Uint8Array | null;
  try {
    bytes = await inflatedUpTo(MOST_BYTES, bytesOfBase64(text.replaceAll('-', '+').replaceAll('_', '/')));
  } catch {
    throw new LinkError('its world is damaged');
  }
  if (!bytes) throw new LinkError('its world is too large for this page');
  try {
    const list = JSON.parse(new TextDecoder().decode(bytes)) as unknown;
    if (!Array.isArray(list) || !list.every((x) => typeof x === 'number')) throw new RangeError();
    const own = situationOf(list as number[]);
    // A list that is too short yields undefined numbers, so its flat list has another length.
    if (flat(own).length !== list.length) throw new RangeError();
    return own;
  } catch {
    throw new LinkError('its world is damaged');
  }
}

const PARTS = ['world', 'seed', 'planner', 'noise', 'rules', 'own'];

type Words = {kinds: string[]; planners: string[]};

/** Throws LinkError. */
async function readLink(hash: string, {kinds, planners}: Words, otherwise: State): Promise<State> {
  const params = new URLSearchParams(hash.replace(/^#/, ''));
  const take = <T>(name: string, of: (text: string) => T, missing: T): T => {
    const text = params.get(name);
    return text === null ? missing : of(text);
  };
  const demand = <T>(good: boolean, value: T, words: string): T => {
    if (!good) throw new LinkError(words);
    return value;
  };
  const own = params.get('own');
  const stranger = [...params.keys()].find((name) => !PARTS.includes(name));
  demand(stranger === undefined, null, unknownPart(stranger ?? ''));
  return {
    kind: take(
      'world',
      (text) => demand(kinds.includes(text), text, 'its world is unknown to this page'),
      otherwise.kind,
    ),
    seed: take(
      'seed',
      (text) =>
        demand(
          /^[0-9]+$/.test(text) && Number.isSafeInteger(Number(text)),
          Number(text),
          'its seed is not valid',
        ),
      otherwise.seed,
    ),
    who: take(
      'planner',
      (text) => demand(Object.hasOwn(teamsOf(planners), text), text, 'its planner is unknown to this page'),
      otherwise.who,
    ),
    noise: take('noise', noiseOf, [0, 0, 0, 0, 0]),
    rules: take('rules', (text) => demand(/^[0-4]{50}$/.test(text), text, 'its rules are not valid'), null),
    own: own === null ? null : await ownOf(own),
  };
}

export interface Read {
  state: State;
  /** What is wrong with the link; "" for nothing. */
  fault: string;
}

/** Missing parts of the address are taken from `otherwise`, and all of it if a part is wrong. */
export async function stateOf(hash: string, words: Words, otherwise: State): Promise<Read> {
  try {
    return {state: await readLink(hash, words, otherwise), fault: ''};
  } catch (error) {
    if (!(error instanceof LinkError)) throw error;
    return {state: otherwise, fault: error.message};
  }
}
