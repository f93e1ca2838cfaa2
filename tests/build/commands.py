"""Runs the commands of gates that build; each must succeed."""

import subprocess


class Failure(Exception):
    pass


def run(*command):
    """Returns the completed command with its output as text; raises Failure with that output if the exit status is not 0."""
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode:
        raise Failure(f"exit status {done.returncode}: {' '.join(map(str, command))}\n{done.stdout[-3000:]}{done.stderr}")
    return done
