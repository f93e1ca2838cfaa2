// Scenarios at random: many are good, and many are just not.

/** Numbers from 0 to 1, the same for the same seed: mulberry32. */
function numbers(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** At, just within and just beyond these limits, or anywhere between. */
function around(draw, low, high) {
  const edges = [low, high, low - 1e-9, high + 1e-9, low + 1e-9, high - 1e-9, -0];
  return draw() < 0.15 ? edges[Math.floor(draw() * edges.length)] : low + draw() * (high - low);
}

/** `most` of the numbers come from wide ranges; the robot starts near the origin. */
export function randomSituation(seed) {
  const draw = numbers(seed);
  const rare = (chance, odd, usual) => (draw() < chance ? odd() : usual());
  const rarelyUpTo = (most, usual) =>
    around(
      draw,
      0,
      rare(
        0.1,
        () => most,
        () => usual,
      ),
    );
  const place = () => [around(draw, -6, 6), around(draw, -6, 6)];
  const far = () =>
    rare(
      0.01,
      () => around(draw, -1000, 1000),
      () => 0,
    );
  const many = (most, one) => Array.from({length: Math.floor(draw() * (most + 1))}, one);
  const away = () => {
    const [x, y] = place();
    const away = Math.hypot(x, y) || 1;
    return [x + (2 * x) / away + far(), y + (2 * y) / away];
  };
  const size = () =>
    rare(
      0.03,
      () => around(draw, 0, 1e-6),
      () => 0.02 + draw(),
    );
  const polygon = () => {
    const [x, y] = away();
    const corners = 3 + Math.floor(draw() * 4);
    const radius = rare(
      0.1,
      () => around(draw, 0, 1e-4),
      () => 0.05 + draw(),
    );
    const points = Array.from({length: corners}, (_, i) => {
      const angle = (2 * Math.PI * i) / corners;
      return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
    });
    // Across itself.
    if (draw() < 0.1 && corners > 3) [points[0], points[1]] = [points[1], points[0]];
    return points;
  };
  const wall = () => {
    const points = Array.from({length: 2 + Math.floor(draw() * 3)}, away);
    return rare(
      0.05,
      () => [points[0], ...points],
      () => points,
    );
  };
  const mover = () => {
    const path = Array.from({length: 2 + Math.floor(draw() * 2)}, away);
    const k = draw();
    const off = rare(
      0.2,
      () => around(draw, 0, 0.002),
      () => 0,
    );
    const center = [
      path[0][0] + k * (path[1][0] - path[0][0]),
      path[0][1] + k * (path[1][1] - path[0][1]) + off,
    ];
    return {
      center,
      radius: size(),
      path,
      speed: around(
        draw,
        0,
        rare(
          0.1,
          () => 10,
          () => 0.5,
        ),
      ),
    };
  };
  const bounds = () => [around(draw, -9, -3), around(draw, -9, -3), around(draw, 3, 9), around(draw, 3, 9)];
  return {
    seed: rare(
      0.1,
      () => 2 ** 53 - 1,
      () => Math.floor(draw() * 1000),
    ),
    timeLimit: rare(
      0.05,
      () => around(draw, 0, 1e-3),
      () => 1 + 3 * draw(),
    ),
    noise: [
      rarelyUpTo(10, 0.05),
      rarelyUpTo(1, 0.1),
      rarelyUpTo(1, 0.1),
      rarelyUpTo(1, 0.01),
      rarelyUpTo(360, 1),
    ].map((x) => (draw() < 0.7 ? Math.abs(x) : x)),
    world: {
      start: [around(draw, -0.2, 0.2), around(draw, -0.2, 0.2)],
      goal: rare(0.05, () => [around(draw, -1000, 1000), 0], place),
      tolerance: rare(
        0.1,
        () => around(draw, 0, 1000),
        () => 0.001 + 0.2 * draw(),
      ),
      bounds: draw() < 0.3 ? bounds() : null,
      discs: many(4, () => [...away(), size()]),
      polygons: many(2, polygon),
      walls: many(2, wall),
      movers: many(2, mover),
    },
  };
}
