"""`whisker robot check`: the robots that it rejects, its warnings, its test drives, and the header that it writes."""

import json
import pathlib
import subprocess

import whisker
from whisker import SCENARIOS, Case

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


def check(*arguments, **options):
    return whisker.whisker("robot", "check", *arguments, **options)


# A TurtleBot3 whose beams are taken from its LIDAR.
TURTLE = """body_radius_m = 0.124
wheel_track_m = 0.16
wheel_speed_max_mps = 0.22
encoder_counts_per_m = 19755
range_rate_hz = 5
range_latency_s = 0.2
stale_after_s = 0.5
range_cone_deg = {cone}
range_left_x_m = -0.032
range_front_x_m = -0.032
range_right_x_m = -0.032
"""


class RobotCheck(Case):
    def test_a_fit_robot_drives_in_three_worlds(self):
        for name, text in (
            ("reference", ""),
            ("small", "body_radius_m = 0.075\nwheel_track_m = 0.11\nencoder_counts_per_m = 3200\n"),
            ("large", "[robot]\nbody_radius_m = 0.2\nwheel_track_m = 0.3\n"),
        ):
            robot = self.file(f"{name}.toml", text)
            done = check(robot)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertEqual([line.split(":")[0] for line in done.stdout.splitlines()],
                             ["the empty world", "the corridor", "the field of discs", "not set, so the reference robot's", "fit"])  # fmt: skip
            result = json.loads(check(robot, "--json").stdout)
            self.assertEqual((result["fit"], result["violations"], result["warnings"]), (True, [], []))
            self.assertEqual([drive["outcome"] for drive in result["drives"]], ["reached"] * 3)

    def test_every_violation_is_a_line_and_run_refuses_the_same(self):
        robot = self.file("bad.toml", "range_clear_m = 0.15\nstale_after_s = 0.03\n[robot]\ncreep_speed_mps = 0.01\n")
        done = check(robot, "--header", self.folder / "bad.hpp")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        *lines, advice = done.stderr.splitlines()
        self.assertEqual([line.split(": ")[0] for line in lines], [f"{robot}:{place}" for place in ("2:17", "1:17", "4:19")])
        self.assertRegex(advice, rf"{robot}:1:1: all of this fits with stale_after_s = ")
        for line in lines:
            self.assertRegex(line, r" \(line \d\).*; it would fit with [a-z_]+ (<=|>=|=|from) ")
        self.assertEqual(list(self.contents()), ["bad.toml"], "no header")
        self.assertEqual(whisker.whisker("run", SCENARIOS / "nothing.toml", "--robot", robot).stderr, done.stderr)
        told = check(robot, "--json")
        self.assertEqual((told.returncode, told.stderr), (2, ""))
        result = json.loads(told.stdout)
        self.assertEqual((result["fit"], result["drives"]), (False, []))
        self.assertEqual([v["text"] for v in result["violations"]], lines)
        self.assertEqual(advice.split("fits with ")[1].replace(" and ", ", ").split(", "), [f"{k} = {v}" for k, v in result["suggestion"].items()])

    def test_suggests_what_the_owner_can_change_and_that_fits(self):
        discs = "body_radius_m = 0.12\nwheel_track_m = 0.13 # of the wheels\nrange_rate_hz = 10\nstale_after_s = 0.1 # s\n"
        micromouse = (
            "body_radius_m = 0.055\nwheel_track_m = 0.0761\nwheel_speed_max_mps = 0.4\nwheel_acceleration_max_mps2 = 2\n"
            "motor_lag_s = 0.19\nrange_max_m = 0.25\n"
        )
        for name, text in (("micromouse", micromouse), ("discs", discs)):
            robot, out = self.file(f"{name}.toml", text), self.folder / f"{name}-fit.toml"
            done = check(robot, "--suggest", out)
            self.assertEqual((done.returncode, done.stdout), (2, f"suggestion: {out}\n"), done.stderr)
            self.assertNotRegex(done.stderr, "(counts_per_m|range_max_m|cone_deg|motor_lag_s) (>=|<=|from [0-9])")
            written = out.read_text().splitlines()
            for line in text.splitlines():
                if "speed_max" not in line and "stale" not in line:
                    self.assertIn(line, written)
            self.assertEqual(check(out).returncode, 0, out.read_text())
        self.assertRegex(out.read_text(), r"(?m)^stale_after_s = \S+ # s$")
        spare = check(self.file("spare.toml", ""), "--suggest", self.folder / "none.toml")
        self.assertEqual(spare.returncode, 0)
        self.assertRegex(spare.stdout, "which sets nothing: this is the reference robot\nnothing to suggest: .*none.toml is not written")
        self.assertFalse((self.folder / "none.toml").exists())

    def test_what_only_other_hardware_mends_is_said_and_a_ray_is_no_cone(self):
        rays = self.file("rays.toml", TURTLE.format(cone=1))
        done = check(rays, "--suggest", self.folder / "out.toml")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, "the robot itself would have to differ: it would fit with range_cone_deg from .*; of a scan, let each beam be the nearest reading of a sector 40 degrees")
        self.assertFalse((self.folder / "out.toml").exists())
        self.assertEqual(check(self.file("sector.toml", TURTLE.format(cone=40))).returncode, 0)

    def test_a_file_that_contradicts_itself_is_refused(self):
        for text, says in (
            ('[sensor]\nmodel = "gp2y0a21"\n', r'model = "gp2y0a21" says that a beam is 5 degrees wide, and the robot believes 25 degrees \(range_cone_deg\)'),
            ("[sensor]\nmax_range_m = 0.5\n", r"a beam sees to 0.5 m, and the robot believes 2 m"),
            ("range_cone_deg = 10.3\n[sensor]\ncone_deg = 1\n", r"let each beam be the nearest reading of a sector"),
        ):
            robot = self.file("contradicts.toml", text)
            done = check(robot)
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertRegex(done.stderr, says)
            told = json.loads(check(robot, "--json").stdout)
            self.assertEqual((told["fit"], [v["text"] for v in told["violations"]]), (False, done.stderr.splitlines()))
        self.assertEqual(check(self.file("agrees.toml", "range_cone_deg = 25\n[sensor]\ncone_deg = 17.5\n")).returncode, 0)

    def test_a_robot_that_takes_for_ever_is_not_fit(self):
        slow = check(self.file("slow.toml", "turn_rate_max_radps = 0.1\nrange_cone_deg = 15\n"))
        self.assertEqual(slow.returncode, 6, slow.stdout)
        self.assertRegex(slow.stderr, r"reached in .*, more than 20 times the \d+\.\d s of the straight way at full speed")

    def test_a_drive_that_fails_is_named(self):
        short = self.file("short.toml", "length_budget_m = 5\n")
        done = check(short, "--header", self.folder / "short.hpp")
        self.assertEqual(done.returncode, 6)
        self.assertRegex(done.stderr, r"\Awhisker: \S+short.toml: the drive through the field of discs failed: gave up after .*length_budget.*\n\Z")
        self.assertEqual(list(self.contents()), ["short.toml"], "no header")
        result = json.loads(check(short, "--json").stdout)
        self.assertEqual([drive["outcome"] for drive in result["drives"]], ["reached", "reached", "gave_up"])
        self.assertFalse(result["fit"])

    def test_the_drives_have_the_sensors_of_the_file(self):
        blind = check(self.file("blind.toml", "[sensor]\nreflectance = 0.001\nreflectance_reference = 1\n"))
        self.assertEqual(blind.returncode, 6, blind.stdout)
        self.assertRegex(blind.stderr, r"the drive through the field of discs failed: contact")
        self.assertEqual(check(self.file("ideal.toml", "[sensor]\nincidence_deg = 90\n")).stdout.splitlines()[:3],
                         check(self.file("none.toml", "")).stdout.splitlines()[:3])  # fmt: skip
        noisy = check(self.file("noisy.toml", "[sensor]\nsigma_m = 0.01\n"))
        self.assertEqual(noisy.returncode, 0, noisy.stderr)
        self.assertNotEqual(noisy.stdout.splitlines()[:3], check(self.file("none.toml", "")).stdout.splitlines()[:3])

    def test_warnings_are_lines_and_change_no_status(self):
        robot = self.file("sonar.toml", "range_incidence_deg = 55\nrange_cone_deg = 15\n")
        done = check(robot, "--header", self.folder / "sonar.hpp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "sonar.hpp").exists())
        lines = done.stderr.splitlines()
        self.assertEqual(len(lines), 2)
        self.assertRegex(lines[0], r"^whisker: \S+sonar.toml: warning: walls ahead may be invisible: .* fit with range_side_angle_deg >= 32.5, ")
        self.assertRegex(lines[1], r"^whisker: \S+sonar.toml: warning: the cones leave a gap: ")
        told = check(robot, "--json")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        result = json.loads(told.stdout)
        self.assertTrue(result["fit"])
        self.assertEqual([w["kind"] for w in result["warnings"]], ["invisible_walls", "unseen_strip"])
        for line, warning in zip(lines, result["warnings"]):
            self.assertTrue(line.endswith(": warning: " + warning["text"]))

    def test_the_named_layouts_do_as_the_manual_says(self):
        kinds = {}
        for name in ("reference", "layout-45", "layout-40", "layout-45-true-38", "hc-sr04", "vl53l1x", "gyro"):
            done = check(ROOT / f"host/robots/{name}.toml", "--json")
            self.assertEqual(done.returncode, 0, done.stdout)
            kinds[name] = [w["kind"] for w in json.loads(done.stdout)["warnings"]]
        self.assertEqual(kinds, {"reference": [], "layout-45": [], "layout-40": [], "layout-45-true-38": ["invisible_walls"],
                                 "hc-sr04": [], "vl53l1x": [], "gyro": []})  # fmt: skip

    def test_the_radius_is_around_the_axle(self):
        turtle = self.file("turtle.toml", "wheel_track_m = 0.16\nbody_radius_m = 0.105\n")
        body = ("--rectangle", "0.14", "0.14", "0.038")
        done = check(turtle, *body)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertEqual(done.stderr, f"{turtle}:2:17: body_radius_m = 0.105: the disc around the middle of the axle must hold the body; "
                                      "0.14 x 0.14 m with the axle 0.038 m behind the front need 0.124 m\n")  # fmt: skip
        told = json.loads(check(turtle, *body, "--json").stdout)
        self.assertEqual((told["fit"], [v["text"] for v in told["violations"]]), (False, [done.stderr.rstrip()]))
        self.refused("robot", "check", self.file("none.toml", ""), "--rectangle", 0.2, 0.1, 0.1, says="none.toml:1:1: body_radius_m = 0.09: ")
        held = check(self.file("held.toml", "body_radius_m = 0.124\nwheel_track_m = 0.16\n"), *body)
        self.assertEqual(held.returncode, 0, held.stderr)
        self.assertEqual(held.stdout.splitlines()[0], "body: within 0.1237 m around the middle of the axle; body_radius_m is 0.124")
        for values, says in (((0.14, 0.14, 0.2), "the axle must lie within the length"), ((0.14, "nan", 0), "'nan' is no number"), ((0.1, 0.1), "3")):
            self.refused("robot", "check", turtle, "--rectangle", *values, says=says)

    def test_files_that_are_none(self):
        self.refused("robot", says="robot")
        self.refused("robot", "check", says="ROBOT")
        self.refused("robot", "check", "missing.toml", says="missing.toml:1:1: ")
        self.file("odd.toml", "nonsense = 1\n")
        self.refused("robot", "check", "odd.toml", "--json", says="odd.toml:1:1: unknown key 'nonsense'")
        self.refused("robot", "check", "odd.toml", "--header", "odd.toml", says="would overwrite")


class Owned(Case):
    """The robots that people own: host/robots/owned, and the Pico robot."""

    ROBOTS = (*sorted((ROOT / "host/robots/owned").glob("*.toml")), ROOT / "host/robots/pico.toml")
    # Each cannot drive with what it has: file, what is said of it.
    REFUSED = {
        "servo-car": ("'encoder_counts_per_m' must be from 100 to 1000000, but is 0", "'range_rate_hz' must be from 5 to 100, but is 1"),
        "e-puck2-infrared": ("'range_max_m' must be from 0.2 to 60 m, but is 0.07",),
        "thymio": ("'encoder_counts_per_m' must be from 100 to 1000000, but is 0", "'range_max_m' must be from 0.2 to 60 m, but is 0.09"),
    }

    def test_each_fits_as_it_stands_and_sets_what_is_its_own(self):
        self.assertEqual(len(self.ROBOTS), 17)
        for robot in self.ROBOTS:
            done = check(robot, "--json")
            self.assertEqual(done.returncode, 0, f"{robot}: {done.stdout}{done.stderr}")
            result = json.loads(done.stdout)
            self.assertTrue(result["fit"], robot)
            if robot.stem != "pico":
                self.assertEqual([key for key in result["unset"] if key != "range_offset_m"], [], robot)

    def test_each_figure_has_its_source(self):
        for robot in self.ROBOTS[:-1]:
            for line in robot.read_text().split("[sensor]")[0].splitlines():
                if line.startswith(("body_", "wheel_", "encoder_", "turn_", "motor_", "range_")) and "_x_m" not in line and "_y_m" not in line:
                    self.assertRegex(line, r"^\w+ = \S+ +# \S", robot)

    def test_what_no_setting_mends_is_refused_with_the_reason(self):
        files = sorted((ROOT / "tests/cli/robots").glob("*.toml"))
        self.assertEqual([file.stem for file in files], sorted(self.REFUSED))
        for file in files:
            done = check(file)
            self.assertEqual((done.returncode, done.stdout), (2, ""), file)
            self.assertEqual([line.split(": ", 1)[1] for line in done.stderr.splitlines()], list(self.REFUSED[file.stem]))

    def test_are_listed_from_the_folder_that_the_command_comes_with(self):
        done = whisker.whisker("robot", "list")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        *lines, last = done.stdout.splitlines()
        self.assertRegex(last, r"^\d+ robots in \S+/host/robots; ")
        for robot in self.ROBOTS[:-1]:
            one = [line for line in lines if line.split()[0] == f"owned/{robot.stem}"]
            self.assertRegex(one[0], r"^owned/\S+ +[a-z]\S* ?\S* +\d+ counts/m  fits  \S")
        self.assertRegex(done.stdout, r"(?m)^owned/romi  +vl53l0x +6535 counts/m  fits  Pololu Romi with three VL53L0X")

    def test_a_folder_with_a_robot_that_does_not_fit(self):
        (self.folder / "robots").mkdir()
        for name, text in (("good.toml", "# Mine. It has wheels.\nencoder_counts_per_m = 1234\n"), ("bad.toml", "range_rate_hz = 1\n"), ("notes.txt", "")):
            (self.folder / "robots" / name).write_text(text)
        done = whisker.whisker("robot", "list", "robots", cwd=self.folder)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        bad, good, last = done.stdout.splitlines()
        self.assertEqual(bad, "bad   refused: robots/bad.toml:1:17: 'range_rate_hz' must be from 5 to 100, but is 1")
        self.assertEqual(good, "good  ideal       1234 counts/m  fits  Mine")
        self.assertEqual(last, "2 robots in robots; `whisker robot check` drives one")
        told = json.loads(whisker.whisker("robot", "list", "robots", "--json", cwd=self.folder).stdout)
        self.assertEqual([(r["name"], r["fits"]) for r in told["robots"]], [("bad", False), ("good", True)])
        self.assertEqual((told["robots"][1]["encoder_counts_per_m"], told["robots"][1]["refused"]), (1234, None))
        self.refused("robot", "list", "nowhere", says="nowhere: no robot files")


class Header(Case):
    def compiled(self, text, core=ROOT, compiler="g++"):
        source = self.file("use.cpp", text)
        command = [compiler, "-std=c++17", "-Wall", "-Wextra", "-Werror", "-Wconversion", f"-I{core}", f"-I{self.folder}", "-fsyntax-only", source]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_compiles_and_holds_what_the_file_says(self):
        robot = self.file("my robot.toml", "body_radius_m = 0.075\nwheel_track_m = 0.11\nconsensus = \"median\"\nmax_tick_gap_s = 0.09\nwheel_ratio = 1.01\n")
        header = self.folder / "my_robot.hpp"
        done = check(robot, "--header", header)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn(f"header: {header}\n", done.stdout)
        text = header.read_text()
        self.assertIn("static_assert(whisker::check(my_robot()) == whisker::ParamFault::none", text)
        self.assertEqual(text.count("  p."), 5, "only what differs from the reference robot")
        subprocess.run([ROOT / "scripts/amalgamate", self.folder / "two"], check=True, capture_output=True)
        for core in (ROOT, self.folder / "two"):
            self.compiled(
                '#include "my_robot.hpp"\n#include "my_robot.hpp"\nusing namespace whisker;\n'
                "static_assert(my_robot().body.radius == 75_mm && my_robot().safety.max_gap == 90_ms);\n"
                "static_assert(my_robot().conditioning.consensus == Consensus::median);\n"
                "static_assert(my_robot().wheels.ratio == millionths(1010000));\n",
                core,
            )

    def test_every_parameter_has_its_field(self):
        """Each parameter slightly off its default, if the relations hold with that change alone."""
        keys = (ROOT / "docs/parameters.md").read_text().split("<!-- params:begin -->")[1].split("<!-- params:end -->")[0]
        rows = [[cell.strip() for cell in row.strip("|").split("|")] for row in keys.splitlines() if row.startswith("| `")]
        wanted = []
        for key, unit, default, _ in rows:
            key = key.strip("`")
            if key in ("bumper", "creep_speed_mps", "gyro", "straight_walls"):  # nothing without other parameters
                continue
            other = {"boolean": lambda: {"true": "false", "false": "true"}[default], "integer": lambda: int(default) + 1, "one of": lambda: {"agreeing": '"median"', "accept": '"refuse"'}[default.strip('"')]}
            value = other.get(unit, lambda: round(float(default) * 1.05, 4) or 0.02)()
            zeros = {"range_clear_m": 1.5, "max_tick_gap_s": 0.03}
            # Slightly more does not fit: the default is the limit, or zero stands for another parameter.
            own = {"range_incidence_deg": 80, "range_right_angle_deg": -31}
            own.update({f"range_{beam}_cone_deg": 20 for beam in ("left", "front", "right")})
            value = {**zeros, **own}.get(key, value)
            robot = self.file("one.toml", f"{key} = {value}\n")
            done = check(robot, "--header", self.folder / "one.hpp")
            self.assertIn(done.returncode, (0, 6), (key, done.stderr))
            if done.returncode == 0:
                wanted.append(key)
                self.assertIn(f"// {key} = ", (self.folder / "one.hpp").read_text())
        self.assertGreater(len(wanted), len(rows) - 5)


if __name__ == "__main__":
    whisker.main()
