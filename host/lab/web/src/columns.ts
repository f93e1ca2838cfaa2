/** Reads what host/lab/page/columns.hpp writes: columns of zigzag LEB128 integers, as differences of an order. */

/** Name, order of the differences, units of the integers in one, number of values. */
export type ColumnInfo = [name: string, order: number, perUnit: number, count: number];

export class ColumnError extends Error {}

export function decodeColumns(bytes: Uint8Array, infos: ColumnInfo[]): Map<string, Float64Array> {
  const columns = new Map<string, Float64Array>();
  let at = 0;
  for (const [name, order, perUnit, count] of infos) {
    const values = new Float64Array(count);
    let last = 0;
    let difference = 0;
    for (let i = 0; i < count; ++i) {
      // Not with shifts: values may have more than 32 bits.
      let raw = 0;
      let place = 1;
      let byte: number;
      do {
        if (at >= bytes.length) throw new ColumnError(`the data ends within column ${name}`);
        byte = bytes[at++];
        raw += (byte & 0x7f) * place;
        place *= 128;
      } while (byte >= 0x80);
      const value = raw % 2 === 0 ? raw / 2 : -(raw + 1) / 2;
      if (order === 0) last = value;
      else if (order === 1) last += value;
      else last += difference += value;
      values[i] = last / perUnit;
    }
    columns.set(name, values);
  }
  if (at !== bytes.length) throw new ColumnError(`${bytes.length - at} bytes behind the last column`);
  return columns;
}

/** A column that more values may follow. */
export class GrowingColumn {
  private length: number;

  constructor(private values: Float64Array) {
    this.length = values.length;
  }

  /** All values so far. */
  append(more: Float64Array): Float64Array {
    const length = this.length + more.length;
    if (length > this.values.length) {
      const larger = new Float64Array(2 * length);
      larger.set(this.values.subarray(0, this.length));
      this.values = larger;
    }
    this.values.set(more, this.length);
    this.length = length;
    return this.values.subarray(0, length);
  }
}

export function bytesOfBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

export async function inflated(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** The same for bytes from an untrusted source: null, without more memory, if they unpack to more than `most`. */
export async function inflatedUpTo(most: number, bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array | null> {
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
  const all = new Uint8Array(most);
  let length = 0;
  for (;;) {
    const {done, value} = await reader.read();
    if (done) return all.subarray(0, length);
    if (length + value.length > most) {
      await reader.cancel();
      return null;
    }
    all.set(value, length);
    length += value.length;
  }
}
