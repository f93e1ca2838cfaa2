"""Runs compilers in parallel. LONG: whether a gate does all of its work, as every night (WHISKER_LONG, docs/development.md)."""

import concurrent.futures
import os
import subprocess

LONG = "WHISKER_LONG" in os.environ


def run_one(job):
    name, command, source = job
    done = subprocess.run(command, input=source, capture_output=True, text=True, check=False)
    output = done.stdout + done.stderr
    return name, (output or f"exit status {done.returncode}, no message") if done.returncode else ""


def compile_all(jobs):
    """jobs: (name, command, standard input or None). Yields (name, the messages of a failure or "")."""
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from pool.map(run_one, jobs)
