// What the measurements of both pages share: measure.mjs and measure_playground.mjs.

const LOADS = 7;

/** The p-quantile of these values. */
export function at(values, p) {
  return [...values].sort((a, b) => a - b)[Math.max(0, Math.ceil(p * values.length) - 1)];
}

/** Milliseconds from asking for the file to the first picture. */
async function loadTime(browser, url, options) {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForFunction(() => document.body.dataset.view);
  const time = await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => setTimeout(() => done(performance.now())))),
  );
  await context.close();
  return time;
}

/** Loads the page some times, each as if for the first time. */
export async function printLoadTime(browser, url, options) {
  const loads = [];
  for (let i = 0; i < LOADS; ++i) loads.push(await loadTime(browser, url, options));
  print('load', `${at(loads, 0.5).toFixed(0)} ms, median of ${LOADS}`);
}

export function print(name, words) {
  console.log(`${name.padEnd(20)}${words}`);
}

/** Of the gaps between frames, ms. */
export function frameRate(gaps) {
  const rate = 1000 / (gaps.reduce((sum, gap) => sum + gap, 0) / gaps.length);
  return `${rate.toFixed(0)} frames a second, 95 % within ${at(gaps, 0.95).toFixed(1)} ms`;
}
