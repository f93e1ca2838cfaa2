/** The page of a rule base: its table answers in the integers of the header, as a chip does. */
import {Address, copied, linkWith, sayLinkFault, unknownPart} from './address.ts';
import {blend, rgb} from './colour.ts';
import {element, make, setText} from './dom.ts';
import {Theme, type Palette} from './theme.ts';

/** As host/lab/rules/page.cpp writes them. */
interface Scale {
  name: string;
  origin: number;
  per_unit: number;
}
interface Input extends Scale {
  low: number;
  high: number;
  grid_low: number;
  grid_high: number;
  shift: number;
  nodes: number;
}
interface Output extends Scale {
  odd: boolean;
  error: number;
}

const {inputs, outputs, nodes} = JSON.parse(element('data').textContent!) as {
  inputs: Input[];
  outputs: Output[];
  nodes: number[];
};

/** Cell and offset of a raw value, as in the header: a node belongs to the cell below it. */
function place(input: Input, raw: number): {cell: number; offset: number} {
  const x = Math.min(Math.max(raw, input.grid_low), input.grid_high) - input.grid_low;
  const cell = (x - (x > 0 ? 1 : 0)) >> input.shift;
  return {cell, offset: x - (cell << input.shift)};
}

/** The raw answer of an output, in integers. */
function lookUp(o: number, raw: number[]): number {
  const [a, b] = inputs.map((input, i) => place(input, raw[i]));
  const columns = inputs.length > 1 ? inputs[1].nodes : 1;
  const node = (row: number, column: number) => nodes[(row * columns + column) * outputs.length + o];
  let bits = inputs[0].shift;
  let sum: number;
  if (!b) {
    sum = ((1 << bits) - a.offset) * node(a.cell, 0) + a.offset * node(a.cell + 1, 0);
  } else {
    const w3 = a.offset * b.offset;
    const w2 = (a.offset << inputs[1].shift) - w3;
    const w1 = (b.offset << inputs[0].shift) - w3;
    bits += inputs[1].shift;
    const w0 = (1 << bits) - w1 - w2 - w3;
    sum =
      w0 * node(a.cell, b.cell) +
      w1 * node(a.cell, b.cell + 1) +
      w2 * node(a.cell + 1, b.cell) +
      w3 * node(a.cell + 1, b.cell + 1);
  }
  if (bits === 0) return sum;
  const half = 1 << (bits - 1);
  return (sum + (outputs[o].odd && sum >= 0 ? half - 1 : half)) >> bits;
}

const digits = (value: number) => String(Number(value.toPrecision(6)));

/** Three digits, rounded up: a bound stays one. */
function bound(error: number): string {
  if (error === 0) return '0';
  const unit = 10 ** (Math.floor(Math.log10(error)) - 2);
  return String(Number((Math.ceil(error / unit) * unit).toPrecision(3)));
}

const sliders = inputs.map(({name, low, high}) => {
  const slider = document.createElement('input');
  Object.assign(slider, {type: 'range', min: low, max: high, step: 1, name});
  const shown = make('output');
  const label = make('label', '', [document.createTextNode(name), slider, shown]);
  element('inputs').append(label);
  return {slider, shown};
});
const answers = outputs.map(({name}) => {
  const value = make('dd');
  element('answers').append(make('div', '', [make('dt', '', name), value]));
  return value;
});

const valueOf = (i: number) => inputs[i].origin + Number(sliders[i].slider.value) / inputs[i].per_unit;
const hash = () => `#${new URLSearchParams(inputs.map(({name}, i) => [name, digits(valueOf(i))]))}`;
const address = new Address(hash);

function answer(): void {
  const raw = sliders.map(({slider}) => Number(slider.value));
  sliders.forEach(({slider, shown}, i) => {
    shown.textContent = digits(valueOf(i));
    slider.setAttribute('aria-valuetext', shown.textContent);
  });
  answers.forEach((shown, o) => {
    const {origin, per_unit: perUnit, error} = outputs[o];
    const answered = lookUp(o, raw);
    const more = make('small', '', `within ${bound(error)}; raw ${answered}`);
    shown.replaceChildren(digits(origin + answered / perUnit), more);
  });
}

/** Asks what the address asks; the middle of an input that it does not name. */
function follow(): void {
  const asked = new URLSearchParams(location.hash.slice(1));
  const stranger = [...asked.keys()].find((name) => !inputs.some((input) => input.name === name));
  let fault = stranger === undefined ? '' : unknownPart(stranger);
  inputs.forEach(({name, origin, per_unit: perUnit, low, high}, i) => {
    const text = asked.get(name);
    let raw = Math.round((low + high) / 2);
    if (text !== null) {
      const told = Math.round((Number(text) - origin) * perUnit);
      if (text.trim() !== '' && told >= low && told <= high) raw = told;
      else
        fault ||= `its ${name} is not a number from ${digits(origin + low / perUnit)} to ${digits(origin + high / perUnit)}`;
    }
    sliders[i].slider.value = String(raw);
  });
  sayLinkFault(fault);
  answer();
}

/** As the heat maps of the replay page. */
const STOPS: Record<string, (p: Palette) => string[]> = {
  diverging: (p) => [p['turn-right'], p['turn-none'], p['turn-left']],
  sequential: (p) => [p['step-small'], p['step-large']],
};

function paint(palette: Palette): void {
  for (const [scale, stopsOf] of Object.entries(STOPS)) {
    const stops = stopsOf(palette).map(rgb);
    const fill = (part: SVGElement, k: number) => (part.style.fill = `rgb(${blend(stops, k)})`);
    for (const map of document.querySelectorAll(`.picture .${scale}`)) {
      for (const level of map.querySelectorAll<SVGElement>('[data-k]')) fill(level, Number(level.dataset.k));
      const bands = [...map.querySelectorAll<SVGElement>('.colour-bar rect')];
      bands.forEach((band, i) => fill(band, (i + 0.5) / bands.length));
    }
  }
}

const theme = new Theme();
theme.onChange(() => paint(theme.palette));
paint(theme.palette);
for (const {slider} of sliders) {
  slider.addEventListener('input', () => {
    answer();
    address.change();
  });
}
addEventListener('hashchange', follow);
element('link').addEventListener('click', async () => {
  setText('link-says', (await copied(linkWith(hash()))) ? 'Link copied' : 'The address bar has the link');
});
follow();
document.body.dataset.view = 'rules';
