// An HC-SR04 at its two pins. Data sheet (ElecFreaks): a pulse of at least 10 us on TRIG, eight periods of 40 kHz, then ECHO
// is high for the time of flight, 2 cm to 4 m; the Cytron user's manual: 38 ms without an echo. Modules in use raise ECHO about
// 0.45 ms after the trigger. Some lock up where there is no echo: ECHO stays high until the power is cycled
// (forum.arduino.cc, "Ultrasonic distance sensor HC-SR04 lack of timeout problem").

const LEAST_PULSE_NS = 10e3;
const RISES_NS = 450e3;
const NO_ECHO_NS = 38e6;
const NS_OF_MM = 2e6 / 343.2; // at 20 degrees
const NEAREST_MM = 10; // what a target within the least range of 2 cm reads as: assumed
const OK = 0;
const CLEAR = 1;
const TOO_NEAR = 2;

export class HcSr04 {
  /** 'unplugged' (ECHO is pulled down), 'held' (ECHO is high), 'locked' (from the next ping on), 'deaf' (TRIG is cut). */
  #fault = null;
  /** Times of the triggers, ns. */
  pings = [];
  /** What it drives ECHO to. */
  high = false;
  #sees = {mm: 0, status: CLEAR};

  constructor(chip, trigger, echo) {
    this.chip = chip;
    this.pins = {trigger, echo};
  }
  plug(mcu) {
    this.mcu = mcu;
    this.busy = false;
    this.echo = mcu.gpio[this.pins.echo];
    this.alarm = mcu.clock.createAlarm(() => (this.high ? this.#fall() : this.#rise()));
    this.#drive(false);
    const pin = mcu.gpio[this.pins.trigger];
    let rose = null;
    pin.addListener(() => {
      if (pin.outputEnable && pin.outputValue) rose ??= mcu.clock.nanos;
      else if (rose !== null) {
        if (mcu.clock.nanos - rose < LEAST_PULSE_NS)
          this.chip.sin(`a trigger of ${mcu.clock.nanos - rose} ns`);
        rose = null;
        this.#trigger();
      }
    });
  }
  set fault(fault) {
    this.#fault = fault;
    this.#drive(this.high);
  }
  #drive(high) {
    this.high = high;
    this.echo.setInputValue(this.#fault === 'held' || (this.#fault !== 'unplugged' && high));
  }
  #trigger() {
    if (this.#fault === 'deaf') return;
    this.pings.push(this.mcu.clock.nanos);
    if (this.busy || this.#sees.status > TOO_NEAR) return;
    this.busy = true;
    this.alarm.schedule(RISES_NS);
  }
  #rise() {
    this.#drive(true);
    if (this.#fault === 'locked') return;
    const {mm, status} = this.#sees;
    const flight = status === TOO_NEAR ? NEAREST_MM * NS_OF_MM : status === OK ? mm * NS_OF_MM : NO_ECHO_NS;
    this.alarm.schedule(flight);
  }
  #fall() {
    this.busy = false;
    this.#drive(false);
  }
  /** What it would measure now: distance and status of the simulator. */
  measured(mm, status) {
    this.#sees = {mm, status};
  }
}
