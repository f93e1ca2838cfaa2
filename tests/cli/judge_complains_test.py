"""The judge detects and names every kind of wrong trace and wrong result."""

import copy
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import whisker
from judge import judge
from judging import scenario, trace
from whisker import HERE, SCENARIOS, Case, with_time_limit

CONTACT, USUAL = "run_over", "two_discs_and_a_wall"
LIMIT = 8  # s of simulated time: gives a few hundred rows


def moving_row(track):
    """A row in the middle of a straight drive."""
    return next(i for i, r in enumerate(track.rows) if r.v_left > 0.1 and r.v_right > 0.1)


class JudgeComplains(Case):
    @classmethod
    def setUpClass(cls):
        box = tempfile.TemporaryDirectory(prefix="whisker-cli-")
        cls.addClassCleanup(box.cleanup)
        cls.runs = {name: cls.run_of(pathlib.Path(box.name), name) for name in (CONTACT, USUAL)}

    @classmethod
    def run_of(cls, folder, name):
        """Scenario, trace and result of a short run; caches the files of the last run as text."""
        scene, path = folder / f"{name}.toml", folder / f"{name}.csv"
        scene.write_text(with_time_limit((SCENARIOS / f"{name}.toml").read_text(), LIMIT))
        run = whisker.whisker("run", scene, "--trace", path, "--json")
        cls.scene, cls.rows, cls.result = scene, path.read_text(), run.stdout
        return scenario.load(scene), trace.load(path), json.loads(run.stdout)

    def test_accepts_the_runs_before_they_are_spoilt(self):
        for name, run in self.runs.items():
            self.assertEqual(judge(*run), [], name)
        self.assertEqual(self.runs[CONTACT][2]["outcome"], "contact")

    def object_to(self, expected, change, name=USUAL):
        """`change` gets copies of scenario, trace and result, and corrupts one of them."""
        spoilt = copy.deepcopy(self.runs[name])
        change(*spoilt)
        complaints = judge(*spoilt)
        self.assertTrue(any(expected in line for line in complaints), f"no '{expected}' in {complaints}")

    def object_to_row(self, expected, **fields):
        """Changes fields of one row by functions of their old values."""

        def change(_, track, __):
            i = moving_row(track)
            row = track.rows[i]
            track.rows[i] = row._replace(**{k: f(getattr(row, k)) for k, f in fields.items()})

        self.object_to(expected, change)

    def test_objects_to_a_row_shifted_along_the_way_or_across_it(self):
        self.object_to_row("where the wheels give", x=lambda x: x + 1e-4)
        self.object_to_row("sideways", y=lambda y: y + 1e-4)

    def test_objects_to_a_turned_row(self):
        self.object_to_row("rad where the wheels give", heading=lambda h: h + 3e-4)

    def test_objects_to_a_late_row_and_to_a_missing_one(self):
        self.object_to_row("after the row before", t=lambda t: t + 0.001)
        self.object_to("after the row before", lambda _, track, __: track.rows.pop(100))

    def test_objects_to_a_teleport(self):
        def change(_, track, __):
            i = moving_row(track)
            track.rows[i:] = [r._replace(x=r.x + 0.3) for r in track.rows[i:]]

        self.object_to("where the wheels give", change)

    def test_objects_to_wheels_that_are_too_fast_or_change_too_quickly(self):
        self.object_to_row("a wheel turns at", v_left=lambda _: 0.3002)
        self.object_to_row("a wheel's speed changed", v_right=lambda v: v - 0.03)

    def test_objects_to_a_body_that_faces_aside_of_its_way(self):
        def change(_, track, __):
            track.rows[:] = [r._replace(heading=r.heading + 0.05) for r in track.rows]

        self.object_to("sideways", change)
        self.object_to("the heading is", change)

    def test_objects_to_another_start(self):
        self.object_to("from the start", lambda scene, *_: setattr(scene, "start", (0.001, 0.0)))

    def test_objects_to_each_wrong_range(self):
        for beam, name in enumerate(("left", "front", "right")):
            for wrong in (0.002, -0.002, 0.3):

                def shift(ranges, beam=beam, wrong=wrong):
                    return tuple(r + wrong * (i == beam) for i, r in enumerate(ranges))

                self.object_to_row(f"{name}:", ranges=shift)

    def test_objects_to_a_lost_reading_without_dropout(self):
        self.object_to_row("without dropout", ranges=lambda r: (r[0], None, r[2]))

    def test_objects_to_ranges_that_miss_an_obstacle(self):
        for change in (
            lambda scene, *_: scene.discs.append(((0.7, 0.7), 0.1)),
            lambda scene, *_: scene.walls.append([(0.5, 0.7), (0.7, 0.6)]),
            lambda scene, *_: scene.polygons.append([(0.5, 0.6), (0.7, 0.6), (0.6, 0.7)]),
        ):
            self.object_to("the nearest thing in its cone", change)

    def test_objects_to_a_way_through_each_kind_of_obstacle(self):
        x, y = self.runs[USUAL][1].rows[moving_row(self.runs[USUAL][1])].at
        around = [(x - 1, y - 1), (x + 1, y - 1), (x, y + 2)]
        for change in (
            lambda scene, *_: scene.discs.append(((x, y), 0.01)),
            lambda scene, *_: scene.walls.append([(x, y - 0.2), (x, y + 0.2)]),
            lambda scene, *_: scene.polygons.append(around),
            lambda scene, *_: setattr(scene, "bounds", {"min": [-1.0, -3.0], "max": [x, 3.0]}),
            lambda scene, *_: scene.movers.append(
                scenario.Mover({"center": [x, y - 0.3], "radius_m": 0.1, "path": [[x, y - 0.3], [x, y]], "speed_mps": 1.0})
            ),
        ):
            self.object_to("no contact", change)

    def test_objects_to_a_contact_that_is_not_reported(self):
        def change(_, track, result):
            result.update(outcome="gave_up", ticks=len(track.rows), time_s=track.rows[-1].t)

        self.object_to("no contact", change, CONTACT)

    def test_objects_to_a_contact_that_is_reported_where_there_is_none(self):
        self.object_to("a contact is claimed", lambda *a: a[2].update(outcome="contact", ticks=a[2]["ticks"] - 1))
        self.object_to("a contact is claimed", lambda scene, *_: scene.movers.clear(), CONTACT)

    def test_objects_to_every_number_of_the_result(self):
        for key, wrong, expected in (
            ("time_s", 0.01, "the trace ends at"),
            ("path_m", 0.05, "a path of"),
            ("final_distance_m", 0.001, "from the goal, but"),
            ("min_clearance_m", 0.002, "a clearance of"),
            ("min_clearance_m", -0.005, "a clearance of"),
            ("ticks", 1, "ticks, but"),
        ):
            self.object_to(expected, lambda *a, k=key, w=wrong: a[2].update({k: a[2][k] + w}))

    def test_objects_to_a_wrong_hash_and_to_one_other_command(self):
        self.object_to("hash", lambda *a: a[2].update(hash="0" * 16))
        self.object_to_row("hash", command=lambda c: (c[0], c[1] + 1))

    def test_objects_to_a_goal_that_is_claimed_from_afar(self):
        def change(scene, track, result):
            result["outcome"] = "reached"
            scene.tolerance = math.dist(track.rows[-1].at, scene.goal) - 0.001

        self.object_to("reached, but", change)

    def test_objects_to_a_goal_that_is_denied_from_near(self):
        def change(scene, track, result):
            result["outcome"] = "off_goal"
            scene.tolerance = math.dist(track.rows[-1].at, scene.goal) + 0.001

        self.object_to("off the goal, but only", change)
        self.object_to("the wheels are exact", lambda *a: a[2].update(outcome="off_goal"))

    def test_objects_to_a_belief_that_is_none(self):
        for outcome in ("reached", "off_goal"):
            self.object_to("believes the goal to be", lambda *a, o=outcome: a[2].update(outcome=o, believed_distance_m=0.2))

    def test_objects_to_a_fault_that_drives_on(self):
        def change(_, track, result):
            result["outcome"] = "fault"
            track.rows[-1] = track.rows[-1]._replace(command=(500, 500))

        self.object_to("safe stop", change)

    def test_objects_to_a_run_beyond_its_time(self):
        self.object_to("after the limit", lambda scene, *_: setattr(scene, "time_limit", 1.0))

    def test_objects_to_a_result_without_a_key_and_to_an_unknown_outcome(self):
        self.object_to("min_clearance_m is missing", lambda *a: a[2].pop("min_clearance_m"))
        self.object_to("outcome 'won'", lambda *a: a[2].update(outcome="won"))

    def judge_files(self, rows, result):
        paths = self.file("t.csv", rows), self.file("r.json", result)
        command = [sys.executable, "-B", HERE / "judge.py", self.scene, *paths]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_works_by_hand_on_files(self):
        rows, result = self.rows, self.result
        good = self.judge_files(rows, result)
        self.assertEqual((good.returncode, good.stdout, good.stderr), (0, "", ""))
        for spoilt in (
            rows.replace("x_m", "x", 1),
            rows.partition("\n")[0] + "\n",
            rows + "1.0,2.0\n",
            rows.replace("0.000,0.000000", "0.000,nothing", 1),
            rows.replace("\n0.000,0.000000", "\n0.000,0.0", 1),
            "",
        ):
            bad = self.judge_files(spoilt, result)
            self.assertEqual((bad.returncode, bad.stderr, bad.stdout.count("\n")), (1, "", 1), bad.stdout + bad.stderr)
        self.assertEqual(self.judge_files(rows, "{").returncode, 1)


if __name__ == "__main__":
    whisker.main()
