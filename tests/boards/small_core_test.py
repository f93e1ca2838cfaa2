"""The core as the ATmega328P gets it, on a larger AVR, answers the thesis planner's golden streams as this computer.

That core is small (WHISKER_SMALL) and optimised as a whole, which finds other bugs of the compiler than the AVR
target of the golden streams does.

usage: small_core_test.py TOOL REPLAY EMULATOR IMAGE WORK_FOLDER
"""

import json
import pathlib
import subprocess
import sys

AT_LEAST = 1000  # ticks


def replay(command, recording, answers):
    with open(recording, "rb") as told, open(answers, "wb") as answered:
        subprocess.run(command, stdin=told, stdout=answered, check=True, timeout=120)


def main(tool, host, emulator, image, work):
    work = pathlib.Path(work)
    work.mkdir(parents=True, exist_ok=True)
    subprocess.run([tool, "record", work], check=True)
    expected, answered = work / "thesis.expected", work / "thesis.answered"
    replay([host], work / "thesis.bin", expected)
    replay([emulator, image], work / "thesis.bin", answered)
    judged = subprocess.run([tool, "judge", work / "thesis", expected, answered], capture_output=True, text=True,
                            check=False)
    if judged.returncode:
        print(judged.stdout + judged.stderr)
        return 1
    total = json.loads(judged.stdout)
    print(f"{total['ticks']} ticks, hash {total['hash']}")
    return 0 if total["ticks"] >= AT_LEAST else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
