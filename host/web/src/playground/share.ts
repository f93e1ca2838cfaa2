/** The whole state of the page in its address. */
import {bytesOfBase64, inflated} from '../columns.ts';
import {flat, situationOf, type Situation} from './situation.ts';
import type {Planner} from './core.ts';

/** Alone, or two side by side. */
export const WHO = {
  skirt: ['skirt'],
  thesis: ['thesis'],
  map: ['map'],
  both: ['skirt', 'thesis'],
  'skirt-map': ['skirt', 'map'],
} as const satisfies Record<string, readonly Planner[]>;
export type Who = keyof typeof WHO;

export function isWho(text: string): text is Who {
  return Object.hasOwn(WHO, text);
}

export interface State {
  kind: string;
  seed: number;
  who: Who;
  /** What the visitor made of the world; null while it is the generator's. */
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

function noiseOf(text: string | null): number[] {
  const list = (text ?? '').split('_').map(Number);
  return list.length === 5 && list.every((x) => x >= 0 && Number.isFinite(x)) ? list : [0, 0, 0, 0, 0];
}

async function ownOf(text: string): Promise<Situation | null> {
  try {
    const bytes = await inflated(bytesOfBase64(text.replaceAll('-', '+').replaceAll('_', '/')));
    const list = JSON.parse(new TextDecoder().decode(bytes)) as unknown;
    if (!Array.isArray(list) || !list.every((x) => typeof x === 'number')) return null;
    const own = situationOf(list as number[]);
    // A list that is too short reads as numbers that are none: its own list has another length.
    return flat(own).length === list.length ? own : null;
  } catch {
    return null;
  }
}

/** What the address does not say, or says wrongly, is as in `otherwise`. */
export async function stateOf(hash: string, kinds: string[], otherwise: State): Promise<State> {
  const params = new URLSearchParams(hash.replace(/^#/, ''));
  const kind = params.get('world') ?? '';
  const seed = Number(params.get('seed') ?? NaN);
  const who = params.get('planner') ?? '';
  const rules = params.get('rules') ?? '';
  const own = params.get('own');
  return {
    kind: kinds.includes(kind) ? kind : otherwise.kind,
    seed: Number.isSafeInteger(seed) && seed >= 0 ? seed : otherwise.seed,
    who: isWho(who) ? who : otherwise.who,
    noise: noiseOf(params.get('noise')),
    rules: /^[0-4]{50}$/.test(rules) ? rules : null,
    own: own ? await ownOf(own) : null,
  };
}
