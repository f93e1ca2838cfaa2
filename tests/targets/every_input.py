"""The look-up in packed arithmetic (Cortex-M4, M7, M33) gives the desktop's answer for every input.

usage: every_input.py ROOT
"""

import concurrent.futures
import os
import pathlib
import subprocess
import sys

PACKED = ("cortex-m4", "cortex-m7", "cortex-m33")


def output(command):
    # The desktop program's console is standard error.
    done = subprocess.run(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False
    )
    return done.stdout.strip() if done.returncode == 0 else f"exit status {done.returncode}: {done.stdout.strip()}"


def main(root):
    sys.path.insert(0, str(pathlib.Path(root, "scripts/lib")))
    import chips

    runs = {"desktop": [chips.BUILD / "host/firmware/apps/every-input"]}
    for name in PACKED:
        target = chips.TARGETS[name]
        for build in target.builds:
            if build not in dict(chips.sample()):
                continue
            runs[build] = target.command(chips.image(build, target, "every-input"), serial=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        answers = dict(zip(runs, pool.map(output, runs.values())))
    for name, answer in answers.items():
        print(f"{name}: {answer}")
    wrong = sum(answer != answers["desktop"] for answer in answers.values())
    print(f"every input: {len(answers) - 1} images, {wrong} wrong")
    return 1 if wrong or len(answers["desktop"]) != 8 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
