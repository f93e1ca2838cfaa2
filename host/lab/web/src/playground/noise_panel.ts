/** Noise and sensor faults on sliders. */
import {element, make} from '../dom.ts';

interface Slider {
  label: string;
  unit: string;
  most: number;
  step: number;
  /** The value in a scenario is that of the slider times this. */
  factor: number;
}

/** In the order of NOISE_KEYS. */
const SLIDERS: Slider[] = [
  {label: 'Range noise', unit: 'mm', most: 50, step: 1, factor: 1e-3},
  {label: 'Readings lost', unit: '%', most: 40, step: 1, factor: 1e-2},
  {label: 'False clear', unit: '%', most: 20, step: 0.5, factor: 1e-2},
  {label: 'Wheel scale error', unit: '%', most: 2, step: 0.01, factor: 1e-2},
  {label: 'Heading drift', unit: '°/√m', most: 3, step: 0.1, factor: 1},
];

export const NO_NOISE = [0, 0, 0, 0, 0];
/** The noise of `whisker world --noise`. */
export const REFERENCE_NOISE = [0.01, 0.02, 0.01, 0.0001, 0.3];

export class NoisePanel {
  private readonly inputs: HTMLInputElement[];
  private readonly outputs: HTMLElement[];

  constructor(changed: (noise: number[]) => void) {
    this.inputs = SLIDERS.map(({most, step}, i) => {
      const input = document.createElement('input');
      Object.assign(input, {
        type: 'range',
        min: '0',
        max: String(most),
        step: String(step),
        id: `noise-${i}`,
      });
      input.addEventListener('input', () => changed(this.value()));
      return input;
    });
    this.outputs = SLIDERS.map(() => make('output', 'number'));
    element('noise').replaceChildren(
      ...SLIDERS.map(({label}, i) => {
        const name = make('label', '', label) as HTMLLabelElement;
        name.htmlFor = `noise-${i}`;
        return make('div', 'slider', [name, this.inputs[i], this.outputs[i]]);
      }),
    );
    for (const [id, noise] of [
      ['noise-none', NO_NOISE],
      ['noise-reference', REFERENCE_NOISE],
    ] as const) {
      element(id).addEventListener('click', () => {
        this.show([...noise]);
        changed([...noise]);
      });
    }
  }

  show(noise: number[]): void {
    noise.forEach((value, i) => {
      this.inputs[i].value = String(Number((value / SLIDERS[i].factor).toPrecision(6)));
    });
    this.label();
  }

  private value(): number[] {
    this.label();
    return this.inputs.map((input, i) => Number((Number(input.value) * SLIDERS[i].factor).toPrecision(6)));
  }

  private label(): void {
    this.inputs.forEach((input, i) => {
      const text = `${input.value} ${SLIDERS[i].unit}`;
      this.outputs[i].textContent = text;
      input.setAttribute('aria-valuetext', text);
    });
  }
}
