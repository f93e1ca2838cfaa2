"""cmake --install of this build installs the whisker command, which works without the source tree.

usage: installed_command.py ROOT BUILD_FOLDER CMAKE
"""

import pathlib
import subprocess
import sys
import tempfile

SCENARIO = "[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 1.0\ny_m = 0.0\n"


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    if done.returncode:
        sys.exit(f"exit status {done.returncode}: {' '.join(map(str, command))}\n{done.stdout}{done.stderr}")
    return done.stdout


def main(root, build, cmake):
    with tempfile.TemporaryDirectory() as folder:
        prefix, scenario = pathlib.Path(folder, "prefix"), pathlib.Path(folder, "straight.toml")
        run(cmake, "--install", build, "--prefix", prefix, "--component", "command")
        scenario.write_text('name = "straight"\n' + SCENARIO)
        run(prefix / "bin/whisker", "run", scenario, "--html", "straight.html", cwd=folder)
        if root in pathlib.Path(folder, "straight.html").read_text():
            sys.exit("the page names the source tree")
    print("installed: the command drives")


if __name__ == "__main__":
    main(*sys.argv[1:])
