"""Events of a scenario, from outside: `run`, `hil` and `guard` play them; wrong ones are refused in one line."""

import json
import pathlib

import whisker
from whisker import STATUS, Case

STRAIGHT = pathlib.Path(__file__).parents[2] / "host/lab/rules/laws/straight.toml"
PLACES = "time_limit_s = 60\n[start]\nx_m = 0.0\ny_m = 0.0\n[goal]\nx_m = 2.0\ny_m = 0.0\n[[disc]]\ncenter = [1.0, 0.3]\nradius_m = 0.2\n"


def event(t_s, kind, keys=""):
    return f'[[event]]\nt_s = {t_s}\nkind = "{kind}"\n{keys}'


class Events(Case):
    def scene(self, *events, places=PLACES):
        return self.file("scene.toml", places + "".join(events))

    def json_of(self, command, *arguments):
        done = whisker.whisker(command, *arguments, "--json")
        self.assertTrue(done.stdout, done.stderr)
        result = json.loads(done.stdout)
        if command != "guard":
            self.assertEqual(done.returncode, STATUS[result["outcome"]])
        return result

    def test_a_table_is_read_beside_the_scenario_and_sent_over_the_bus(self):
        self.file("straight.toml", STRAIGHT.read_text())
        events = [event(0.5, "table", 'file = "straight.toml"\n'), event(1, "restart")]
        scene = self.scene(*events, places=PLACES + "[robot]\nbend_course = true\n")
        alone, both = self.json_of("run", scene), self.json_of("hil", scene)
        self.assertEqual((both["hash"], both["events"]), (alone["hash"], {"played": 2, "refused": 0}))

    def test_without_events_nothing_is_said_of_them(self):
        self.assertNotIn("events", self.json_of("run", self.scene()))
        self.assertNotIn("events", self.json_of("guard", self.scene()))

    def test_the_guard_plays_them(self):
        result = self.json_of("guard", self.scene(event(2, "frames_lost", "for_s = 1\n"), event(3, "cancel")))
        self.assertEqual(result["events"], {"played": 1, "refused": 1})
        self.assertEqual(result["outcome"], "reached")

    def test_a_campaign_ignores_them(self):
        (self.folder / "worlds").mkdir()
        hashes = []
        for events in ("", event(1, "cancel")):
            (self.folder / "worlds/a.toml").write_text(PLACES + events)
            csv = self.folder / "rows.csv"
            whisker.whisker("campaign", self.folder / "worlds", "--csv", csv, "--overwrite")
            hashes.append(csv.read_text())
        self.assertEqual(hashes[0], hashes[1])

    def test_wrong_ones_are_refused_before_anything_is_written(self):
        self.scene(event(1, "goal", "x_m = 1.0\n"))
        for command in ("run", "hil", "guard"):
            self.refused(command, "scene.toml", "--trace", "t.csv", says="scene.toml:11:1: [[event]] 1: 'y_m' is missing")
        self.scene(event(1, "table", 'file = "missing.toml"\n'))
        for command in ("run", "hil", "guard"):
            self.refused(command, "scene.toml", "--trace", "t.csv", says="missing.toml:1:1: ")
        self.file("rules.toml", "rules = 1\n")
        self.scene(event(1, "table", 'file = "rules.toml"\n'))
        self.refused("run", "scene.toml", says="rules.toml:")


if __name__ == "__main__":
    whisker.main()
