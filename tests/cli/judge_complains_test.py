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


def row(**fields):
    """Changes fields of one row by functions of their old values."""

    def change(_, track, __):
        i = moving_row(track)
        track.rows[i] = track.rows[i]._replace(**{key: of(getattr(track.rows[i], key)) for key, of in fields.items()})

    return change


def rows(of, first=lambda _: 0):
    """Changes each row from the first one on."""

    def change(_, track, __):
        i = first(track)
        track.rows[i:] = [of(r) for r in track.rows[i:]]

    return change


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

    def objects_to(self, spoilt, name=USUAL):
        """spoilt: (what the judge says, a change of copies of scenario, trace and result)."""
        for expected, change in spoilt:
            run = copy.deepcopy(self.runs[name])
            change(*run)
            complaints = judge(*run)
            with self.subTest(expected):
                self.assertTrue(any(expected in line for line in complaints), f"no '{expected}' in {complaints}")

    def test_objects_to_a_row_that_the_wheels_do_not_give(self):
        self.objects_to((
            ("where the wheels give", row(x=lambda x: x + 1e-4)),
            ("sideways", row(y=lambda y: y + 1e-4)),
            ("rad where the wheels give", row(heading=lambda h: h + 3e-4)),
            ("after the row before", row(t=lambda t: t + 0.001)),
            ("after the row before", lambda _, track, __: track.rows.pop(100)),
            ("where the wheels give", rows(lambda r: r._replace(x=r.x + 0.3), moving_row)),
            ("a wheel turns at", row(v_left=lambda _: 0.3002)),
            ("a wheel's speed changed", row(v_right=lambda v: v - 0.03)),
            ("sideways", rows(lambda r: r._replace(heading=r.heading + 0.05))),
            ("the heading is", rows(lambda r: r._replace(heading=r.heading + 0.05))),
            ("from the start", lambda scene, *_: setattr(scene, "start", (0.001, 0.0))),
        ))  # fmt: skip

    def test_objects_to_ranges_that_miss_or_invent_something(self):
        def shifted(beam, by):
            return row(ranges=lambda ranges: tuple(r + by * (i == beam) for i, r in enumerate(ranges)))

        self.objects_to((f"{name}:", shifted(beam, by)) for beam, name in enumerate(("left", "front", "right")) for by in (0.002, -0.002, 0.3))
        near = "the nearest thing in its cone"
        self.objects_to((
            ("without dropout", row(ranges=lambda r: (r[0], None, r[2]))),
            (near, lambda scene, *_: scene.discs.append(((0.7, 0.7), 0.1))),
            (near, lambda scene, *_: scene.walls.append([(0.5, 0.7), (0.7, 0.6)])),
            (near, lambda scene, *_: scene.polygons.append([(0.5, 0.6), (0.7, 0.6), (0.6, 0.7)])),
        ))  # fmt: skip

    def test_objects_to_a_way_through_each_kind_of_obstacle_and_to_a_contact_that_is_none(self):
        x, y = self.runs[USUAL][1].rows[moving_row(self.runs[USUAL][1])].at
        mover = {"center": [x, y - 0.3], "radius_m": 0.1, "path": [[x, y - 0.3], [x, y]], "speed_mps": 1.0}
        self.objects_to((
            ("no contact", lambda scene, *_: scene.discs.append(((x, y), 0.01))),
            ("no contact", lambda scene, *_: scene.walls.append([(x, y - 0.2), (x, y + 0.2)])),
            ("no contact", lambda scene, *_: scene.polygons.append([(x - 1, y - 1), (x + 1, y - 1), (x, y + 2)])),
            ("no contact", lambda scene, *_: setattr(scene, "bounds", {"min": [-1.0, -3.0], "max": [x, 3.0]})),
            ("no contact", lambda scene, *_: scene.movers.append(scenario.Mover(mover))),
            ("a contact is claimed", lambda *a: a[2].update(outcome="contact", ticks=a[2]["ticks"] - 1)),
        ))  # fmt: skip
        self.objects_to((
            ("no contact", lambda _, track, result: result.update(outcome="gave_up", ticks=len(track.rows), time_s=track.rows[-1].t)),
            ("a contact is claimed", lambda scene, *_: scene.movers.clear()),
        ), CONTACT)  # fmt: skip

    def test_objects_to_every_number_and_word_of_the_result(self):
        def more(key, by):
            return lambda *a: a[2].update({key: a[2][key] + by})

        def goal(outcome, by):
            def change(scene, track, result):
                result["outcome"], scene.tolerance = outcome, math.dist(track.rows[-1].at, scene.goal) + by

            return change

        def drives_on(_, track, result):
            result["outcome"], track.rows[-1] = "fault", track.rows[-1]._replace(command=(500, 500))

        self.objects_to((
            ("the trace ends at", more("time_s", 0.01)),
            ("a path of", more("path_m", 0.05)),
            ("from the goal, but", more("final_distance_m", 0.001)),
            ("a clearance of", more("min_clearance_m", 0.002)),
            ("a clearance of", more("min_clearance_m", -0.005)),
            ("ticks, but", more("ticks", 1)),
            ("hash", lambda *a: a[2].update(hash="0" * 16)),
            ("hash", row(command=lambda c: (c[0], c[1] + 1))),
            ("reached, but", goal("reached", -0.001)),
            ("off the goal, but only", goal("off_goal", 0.001)),
            ("the wheels are exact", lambda *a: a[2].update(outcome="off_goal")),
            *(("believes the goal to be", lambda *a, o=o: a[2].update(outcome=o, believed_distance_m=0.2)) for o in ("reached", "off_goal")),
            ("safe stop", drives_on),
            ("after the limit", lambda scene, *_: setattr(scene, "time_limit", 1.0)),
            ("min_clearance_m is missing", lambda *a: a[2].pop("min_clearance_m")),
            ("outcome 'won'", lambda *a: a[2].update(outcome="won")),
        ))  # fmt: skip

    def judge_files(self, text, result):
        paths = self.file("t.csv", text), self.file("r.json", result)
        command = [sys.executable, "-B", HERE / "judge.py", self.scene, *paths]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_works_by_hand_on_files(self):
        text, result = self.rows, self.result
        good = self.judge_files(text, result)
        self.assertEqual((good.returncode, good.stdout, good.stderr), (0, "", ""))
        for spoilt in (
            text.replace("x_m", "x", 1),
            text.partition("\n")[0] + "\n",
            text + "1.0,2.0\n",
            text.replace("0.000,0.000000", "0.000,nothing", 1),
            text.replace("\n0.000,0.000000", "\n0.000,0.0", 1),
            "",
        ):
            bad = self.judge_files(spoilt, result)
            self.assertEqual((bad.returncode, bad.stderr, bad.stdout.count("\n")), (1, "", 1), bad.stdout + bad.stderr)
        self.assertEqual(self.judge_files(text, "{").returncode, 1)


if __name__ == "__main__":
    whisker.main()
