/** Bytes in a page, as host/lab/web/playground.mjs writes them. */
import {inflated} from '../columns.ts';

/** Out of base 85, and unpacked. */
export function unpacked(packed: string): Promise<Uint8Array> {
  const text = packed.trim().replaceAll('}', '<');
  const words = new Uint32Array((text.length - 1) / 5);
  for (let i = text.length - 1; i > 0; --i) {
    const at = Math.floor((i - 1) / 5);
    words[at] = words[at] * 85 + text.charCodeAt(i) - 40;
  }
  return inflated(new Uint8Array(words.buffer, 0, words.byteLength - Number(text[0])));
}
