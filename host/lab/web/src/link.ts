/** The address says which run and which time: #run=2&t=12.34 */

import {unknownPart} from './address.ts';

export interface Place {
  run: number | null;
  time: number | null;
}

function numberOf(text: string | null): number | null {
  if (text === null || text.trim() === '') return null;
  const value = Number(text);
  return Number.isFinite(value) && value >= 0 ? value : null;
}

/** What is wrong with an address of a page with so many runs; "" for nothing. */
export function faultOf(hash: string, runs: number): string {
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ''))) {
    if (name !== 'run' && name !== 't') return unknownPart(name);
    const value = numberOf(text);
    if (value === null) return `its ${name} is not a number`;
    if (name === 'run' && !(Number.isInteger(value) && value < runs))
      return 'it is to a run that is not in this page';
  }
  return '';
}

export function placeOf(hash: string): Place {
  const params = new URLSearchParams(hash.replace(/^#/, ''));
  return {run: numberOf(params.get('run')), time: numberOf(params.get('t'))};
}

export function hashOf({run, time}: Place): string {
  const parts: string[] = [];
  if (run !== null) parts.push(`run=${run}`);
  if (time !== null) parts.push(`t=${time.toFixed(3).replace(/\.?0+$/, '')}`);
  return parts.length > 0 ? `#${parts.join('&')}` : '';
}
