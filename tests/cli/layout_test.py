"""`whisker robot layout`: the trade that it prints, its chart, and the robot file that it writes."""

import json
import tomllib
import xml.etree.ElementTree

import whisker
from whisker import Case

# Few missions, in worlds without slow rooms for the boundary planner.
QUICK = ("--sensor", "vl53l1x", "--angles", 30, 40, "--count", 1, "--planner", "skirt")


def layout(*arguments):
    return whisker.whisker("robot", "layout", *arguments)


class Layout(Case):
    def test_prints_the_trade_and_writes_chart_and_robot(self):
        svg, robot = self.folder / "l.svg", self.folder / "r.toml"
        done = layout(*QUICK, "--svg", svg, "--out", robot)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        lines = done.stdout.splitlines()
        self.assertIn("vl53l1x on a body of 0.090 m: cone 27.0 degrees, walls echo up to L = 80 degrees", lines[0])
        self.assertIn("side angles 30 to 40 degrees, offsets 0.000, 0.045, 0.081 m; check() refuses 0 of 6", lines[1])
        self.assertIn("seeds 1 to 1", lines[2])
        rows = [line.split() for line in lines if line[:6].strip() in ("30.0", "40.0")]
        self.assertEqual(len(rows), 6)
        self.assertEqual({(row[0], row[2]) for row in rows}, {("30.0", "46.5"), ("40.0", "36.5")}, "90 - A - cone / 2")
        best = next(line for line in lines if line.startswith("best: "))
        self.assertEqual(best, f"best: range_side_angle_deg = {float(rows[0][0]):g}, range_offset_m = {rows[0][1]}")
        self.assertIn("why: of 6 layouts, 6 see every wall ahead with 5 degrees to spare; ", done.stdout)
        self.assertEqual(lines[-2:], [f"chart: {svg}", f"robot: {robot}"])

        picture = xml.etree.ElementTree.parse(svg).getroot()
        def of_class(name):
            return [e for e in picture.iter() if e.get("class") == name]

        self.assertEqual(len(of_class("layout")), 6, "a line for each offset in both plots")
        self.assertEqual(len(of_class("best")), 2)
        self.assertEqual(len(of_class("rule-note")), 1, "no angle of the chart loses walls")

        made = tomllib.loads(robot.read_text())
        self.assertEqual(made["sensor"], {"model": "vl53l1x"})
        self.assertEqual((made["range_cone_deg"], made["range_incidence_deg"], made["range_rate_hz"]), (27, 80, 30))
        world = self.file("w.toml", whisker.whisker("world", "discs", "--seed", 1).stdout)
        self.assertEqual(whisker.whisker("run", world, "--robot", robot).returncode, 0)
        self.assertEqual(whisker.whisker("robot", "check", robot, "--json").returncode, 0)

    def test_a_cone_that_tapers_counts_where_ground_is_cleared(self):
        angle = ("--sensor", "hc-sr04", "--angles", 45, "--count", 1, "--json")
        far, near = (json.loads(layout(*angle, *clear).stdout) for clear in ((), ("--clear", 0.6)))
        self.assertEqual((far["cone_deg"], near["cone_deg"]), (15, 36.25))
        self.assertEqual((far["rule_angle_deg"], near["rule_angle_deg"]), (42.5, 31.875))
        done = layout("--sensor", "hc-sr04", "--clear", "61")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--clear", done.stderr)

    def test_json_says_the_same_whatever_the_jobs(self):
        told = [layout(*QUICK, "--json", "--jobs", jobs) for jobs in (1, 3)]
        self.assertEqual((told[0].returncode, told[0].stderr), (0, ""))
        self.assertEqual(told[0].stdout, told[1].stdout)
        result = json.loads(told[0].stdout)
        self.assertLessEqual({*whisker.ORIGIN}, result.keys())
        self.assertEqual((result["sensor"], result["refused"], result["refusals"]), ("vl53l1x", 0, {}))
        self.assertEqual(result["worlds"], ["discs", "u-trap", "maze", "rooms"])
        self.assertEqual((result["angles_deg"], result["offsets_m"]), ([30, 40], [0, 0.045, 0.081]))
        self.assertEqual(result["rule_angle_deg"], -3.5)
        self.assertEqual(result["best"], result["layouts"][0])
        for one in result["layouts"]:
            self.assertEqual(one["missions"], 4)
            self.assertAlmostEqual(one["needed_incidence_deg"], 90 - one["side_angle_deg"] - 13.5, 5)
            self.assertAlmostEqual(one["margin_deg"], 80 - one["needed_incidence_deg"], 5)
            self.assertEqual(one["world_s_per_m"].keys(), {*result["worlds"]})
            paces = sorted(p if p is not None else 1e9 for p in one["world_s_per_m"].values())
            self.assertEqual(one["s_per_m"], paces[1], "one mission in each kind of world")
        words = layout(*QUICK, "--seed", 2).stdout
        self.assertIn("seeds 2 to 2", words)
        self.assertNotEqual(json.loads(layout(*QUICK, "--seed", 2, "--json").stdout)["layouts"], result["layouts"])

    def test_body_and_robot_change_the_rest_of_the_robot(self):
        out = self.folder / "r.toml"
        own = self.file("own.toml", "wheel_speed_max_mps = 0.2\nrange_left_x_m = 0.03\n[sensor]\nambient_klux = 2\nmodel = \"hc-sr04\"\n")
        arguments = ("--sensor", "vl53l0x", "--angles", 30, "--count", 1, "--planner", "skirt", "--out", out)
        done = layout(*arguments, "--body", "0.18", "--robot", own)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("vl53l0x on a body of 0.180 m", done.stdout)
        self.assertIn("offsets 0.000, 0.090, 0.162 m", done.stdout)
        made = tomllib.loads(out.read_text())
        self.assertEqual((made["body_radius_m"], made["wheel_track_m"], made["wheel_speed_max_mps"]), (0.18, 0.28, 0.2))
        self.assertNotIn("range_left_x_m", made)
        self.assertEqual(made["sensor"], {"model": "vl53l0x", "ambient_klux": 2})

    def test_skips_what_check_refuses_and_counts_it(self):
        done = layout("--sensor", "vl53l1x", "--angles", 30, 80, "--count", 1, "--planner", "skirt", "--json")
        result = json.loads(done.stdout)
        self.assertEqual((result["refused"], result["refusals"]), (3, {"cones_apart_from_front": 3}))
        self.assertEqual({one["side_angle_deg"] for one in result["layouts"]}, {30})
        self.refused("robot", "layout", "--sensor", "vl53l1x", "--angles", 80, says="check() refuses all 3 layouts (cones_apart_from_front 3)")
        self.refused("robot", "layout", "--sensor", "gp2y0a41", says="check() refuses all 27 layouts")

    def test_wrong_use(self):
        self.refused("robot", "layout", says="--sensor")
        self.refused("robot", "layout", "--sensor", "hcsr04", says="no sensor model 'hcsr04'; did you mean 'hc-sr04'?")
        for body in ("0.01", "2", "nan", ""):
            self.refused("robot", "layout", "--sensor", "tfmini", "--body", body, says="--body")
        for count in ("0", "1001", "-1"):
            self.refused("robot", "layout", "--sensor", "tfmini", "--count", count, says="--count")
        self.refused("robot", "layout", "--sensor", "tfmini", "--angles", "90", says="--angles")
        self.refused("robot", "layout", "--sensor", "tfmini", "--robot", "none.toml", says="none.toml:1:1: ")
        self.file("bad.toml", "range_min_m = 3\n")
        self.refused("robot", "layout", "--sensor", "tfmini", "--robot", "bad.toml", says="bad.toml:1:15: ")
        self.refused("robot", "layout", "--sensor", "tfmini", "--robot", "bad.toml", "--out", "bad.toml", says="would overwrite")
        self.refused("robot", "layout", "--sensor", "tfmini", "--svg", "nowhere/l.svg", says="no such folder")


if __name__ == "__main__":
    whisker.main()
