/** Blends of CSS colours of the form #rrggbb. */
export type Rgb = [number, number, number];

export function rgb(hex: string): Rgb {
  const n = parseInt(hex.slice(1), 16);
  return [n >> 16, (n >> 8) & 255, n & 255];
}

/** The colour at `k`, 0..1, of evenly spaced stops. */
export function blend(stops: Rgb[], k: number): Rgb {
  const at = Math.max(0, Math.min(1, k)) * (stops.length - 1);
  const i = Math.min(stops.length - 2, Math.floor(at));
  return stops[i].map((v, j) => v + (at - i) * (stops[i + 1][j] - v)) as Rgb;
}
