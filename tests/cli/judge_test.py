"""The judge accepts everything that the command writes."""

import concurrent.futures
import json
import os
import subprocess
import sys

import whisker
from whisker import HERE, KINDS, SCENARIOS, STATUS, Case, with_time_limit

LIMIT = 30  # s of simulated time for generated worlds
CERTAIN = {  # outcomes that no planner can change
    "nothing": "reached",
    "goal_at_start": "reached",
    "run_over": "contact",
    "blind": "fault",
    "no_time": "gave_up",
}


def judged(scenario, *options):
    """Runs a scenario and the judge. Returns the result and the complaints."""
    trace, result = scenario.with_suffix(".csv"), scenario.with_suffix(".json")
    run = whisker.whisker("run", scenario, "--trace", trace, "--json", *options)
    result.write_text(run.stdout, encoding="utf-8")
    if run.stderr or not run.stdout:
        return {}, [f"exit status {run.returncode}, standard error: {run.stderr}"]
    outcome = json.loads(run.stdout)
    judge = subprocess.run(
        [sys.executable, "-B", HERE / "judge.py", scenario, trace, result], capture_output=True, text=True, check=False
    )
    complaints = (judge.stdout + judge.stderr).splitlines()
    if judge.returncode != (1 if complaints else 0):
        complaints.append(f"the judge's exit status is {judge.returncode}")
    if run.returncode != STATUS[outcome["outcome"]]:
        complaints.append(f"{outcome['outcome']} with exit status {run.returncode}")
    return outcome, complaints


class Judge(Case):
    def judge_all(self, scenarios):
        outcomes = {}
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for scenario, (result, complaints) in zip(scenarios, pool.map(judged, scenarios)):
                with self.subTest(scenario.stem):
                    self.assertEqual(complaints, [])
                    outcomes[scenario.stem] = result["outcome"]
        return outcomes

    def test_accepts_every_scenario_of_the_folder(self):
        scenarios = [self.file(path.name, path.read_text()) for path in sorted(SCENARIOS.glob("*.toml"))]
        outcomes = self.judge_all(scenarios)
        self.assertGreaterEqual(outcomes.items(), CERTAIN.items())

    def test_accepts_a_generated_world_of_each_kind_with_and_without_noise(self):
        scenarios = []
        for seed, kind in enumerate(KINDS, start=20):
            for noise in ([], ["--noise"]):
                made = whisker.whisker("world", kind, "--seed", seed, *noise)
                self.assertEqual((made.returncode, made.stderr), (0, ""))
                name = f"{kind}{''.join(noise)}.toml"
                scenarios.append(self.file(name, with_time_limit(made.stdout, LIMIT)))
        self.assertEqual(len(self.judge_all(scenarios)), 2 * len(KINDS))


if __name__ == "__main__":
    whisker.main()
