"""The images for the STM32F405 boot in QEMU, keep their period, and report the peripherals that QEMU lacks.

QEMU's netduinoplus2 has the chip's USART and timers; its clock unit, pins, I2C, CAN, watchdog and random numbers are
absent and its converter never finishes. So every driver must time out. The core of the robot must stop with a fault; absent
pins are low: the button is down from the start, which must not start a calibration. The controller node must stay idle and try
to come onto the bus again and again.

usage: stm32f405_in_qemu.py robot.elf|can-node.elf
"""

import pathlib
import re
import subprocess
import sys
import threading

# In QEMU an instruction takes 1 ns and a timer count 16 ns, the count of a 16 MHz clock.
COMMAND = ["qemu-system-arm", "-M", "netduinoplus2", "-display", "none", "-monitor", "none", "-icount", "shift=0",
           "-serial", "null", "-serial", "stdio", "-kernel"]
REPORTS = 4
SECONDS = 60

NO_CLOCK = {"crystal_not_ready": (1, 1), "pll_not_locked": (1, 1)}
# By image: mode and fault of the core, and the failures after REPORTS seconds.
EXPECTED = {
    # In QEMU the encoders' timers run freely.
    "robot": (("stopped", "encoder_jump"), {
        **NO_CLOCK,
        "can not_started": (1, 1),
        # Each rangefinder is started about ten times a second: the three take turns on the bus.
        "i2c_timeout": (60, 150),
        "ranger_not_started": (60, 150),
        # Three conversions every 48 ms.
        "adc_no_conversion": (150, 300),
    }),
    # One try every 100 ms.
    "can-node": (("idle", "none"), {**NO_CLOCK, "random_not_ready": (1, 1), "can not_started": (30, 45)}),
}  # fmt: skip


def reports_of(image):
    """The first reports that the image prints, one dictionary per report."""
    qemu = subprocess.Popen([*COMMAND, image], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
    deadline = threading.Timer(SECONDS, qemu.kill)
    deadline.start()
    reports = []
    try:
        for line in qemu.stdout:
            line = line.strip()
            if line.startswith("t "):
                if len(reports) == REPORTS:
                    break
                reports.append({"first": line})
            elif line.startswith("calibration "):
                reports[-1][line] = 1
            elif reports:
                name, count = line.rsplit(" ", 1)
                reports[-1][name] = int(count)
    finally:
        deadline.cancel()
        qemu.kill()
        qemu.wait()
    return reports


def problems_of(reports, state, failures):
    if len(reports) < REPORTS:
        return [f"{len(reports)} reports in {SECONDS} s, not {REPORTS}"]
    found = []
    for k, report in enumerate(reports):
        first = re.fullmatch(r"t (\d+) (\w+) (\w+) fault (\w+)", report["first"])
        if not first:
            found.append(f"not a report: {report['first']}")
        elif not 1000 * (k + 1) <= int(first[1]) < 1000 * (k + 1) + 100:
            found.append(f"report {k} at {first[1]} ms")
        elif (first[2], first[4]) != state:
            found.append(f"the core is not {' '.join(state)}: {report['first']}")
    last = {name: count for name, count in reports[-1].items() if name != "first"}
    for name in sorted(failures.keys() | last.keys()):
        low, high = failures.get(name, (0, 0))
        if not low <= last.get(name, 0) <= high:
            found.append(f"{name} {last.get(name, 0)}, not {low} to {high}")
    return found


def main(image):
    reports = reports_of(image)
    problems = problems_of(reports, *EXPECTED[pathlib.Path(image).stem])
    for report in reports:
        print(report)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
