"""The images for the STM32F405 boot in QEMU, keep their period, and report the peripherals that QEMU lacks.

QEMU's netduinoplus2 has the chip's USART and timers; its clock unit, pins, I2C, CAN, watchdog and random numbers are
absent and its converter never finishes. So every driver must time out. The core of the robot must stop with a fault; absent
pins are low: the button is down from the start, which must not start a calibration. The controller node must stay idle and try
to come onto the bus again and again. An image with a fault of the processor in its loop must first cut off the motors.

usage: stm32f405_in_qemu.py robot.elf|can-node.elf
"""

import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import threading

# In QEMU an instruction takes 1 ns and a timer count 16 ns, the count of a 16 MHz clock.
COMMAND = ["qemu-system-arm", "-M", "netduinoplus2", "-display", "none", "-monitor", "none", "-icount", "shift=0"]
REPORTS = 4
SECONDS = 60

# QEMU's log of the processor and of the peripherals that it lacks. The first writes after a fault: both direction inputs of
# both wheels low, and no pulse.
LOGGED = ["-d", "unimp,int"]
CUT_OFF = [f"GPIOB 018 {1 << pin + 16:08x}" for pin in (12, 13, 14, 15)] + ["timer[1] 034 00000000", "timer[1] 038 00000000"]
WRITE = r"(\S+): unimplemented device write \(size 4, offset 0x(\w+), value 0x(\w+)\)"

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
    command = [*COMMAND, "-serial", "null", "-serial", "stdio", "-kernel", image]
    qemu = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
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


def with_fault(image, function):
    """The image, in which this function begins with an undefined instruction."""
    data = bytearray(pathlib.Path(image).read_bytes())
    symbols = subprocess.run(["arm-none-eabi-nm", "-C", image], capture_output=True, text=True, check=True).stdout
    address = next(int(line.split()[0], 16) & ~1 for line in symbols.splitlines() if function in line)
    (table,), (size, count) = struct.unpack_from("<I", data, 28), struct.unpack_from("<HH", data, 42)
    for k in range(count):
        _, offset, virtual, _, length, _ = struct.unpack_from("<6I", data, table + k * size)
        if virtual <= address < virtual + length:
            data[offset + address - virtual : offset + address - virtual + 2] = b"\x00\xde"
    return bytes(data)


def fault_problems(image):
    with tempfile.NamedTemporaryFile(suffix=".elf") as faulty:
        faulty.write(with_fault(image, "RobotBoard::poll("))
        faulty.flush()
        with subprocess.Popen([*COMMAND, *LOGGED, "-kernel", faulty.name], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as qemu:
            deadline = threading.Timer(SECONDS, qemu.kill)
            deadline.start()
            faulted, writes = False, []
            for line in qemu.stderr:
                faulted = faulted or "Taking exception" in line
                write = re.match(WRITE, line)
                if faulted and write:
                    writes.append(" ".join(write.groups()))
                if len(writes) == len(CUT_OFF):
                    break
            deadline.cancel()
            qemu.kill()
    return [] if writes == CUT_OFF else [f"after a fault of the processor: {writes}, not {CUT_OFF}"]


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
    if pathlib.Path(image).stem == "robot":
        problems += fault_problems(image)
    for report in reports:
        print(report)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
