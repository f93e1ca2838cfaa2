"""Each judge of a part complains of a defect that is planted in what it judges.

usage: planted_test.py ROOT COMPILER LIBRARY...
  LIBRARY   that the judges are linked with, in the order of the command line
Exit status: 0 each defect is found, 1 one is not, or its text is no longer in the core.
"""

import pathlib
import subprocess
import sys
import tempfile

SEEDS = 400
# part, file of the core, text, planted text
PLANTED = (
    ("wavefront", "planning/global/wavefront_run.cpp", "diagonal_ = wavefront_.level_ % 2 == 0", "diagonal_ = wavefront_.level_ % 2 == 1"),
    ("map", "planning/global/grid_map.cpp", "kUnitsPerCell * 23 / 32", "kUnitsPerCell * 3 / 32"),
    ("window", "planning/global/grid_map.cpp", "old(w + skip) >> shift", "old(w + skip) << shift"),
    ("raster", "perception/raster.cpp", "end_y_ < 0 ? Rows(y_ + end_y_, y_, reach)", "end_y_ < 0 ? Rows(y_, y_, reach)"),
    ("grid", "perception/local_grid.cpp", "empty.inside_disc(apex.x, dy, free);", "empty.inside_disc(apex.x, dy, free + kUnitsPerCell);"),
    ("paths", "perception/local_grid_queries.cpp", "if (squared >= nearest) return;", "if (squared <= nearest) return;"),
    ("ground", "perception/local_grid.cpp", "young_[s] &= ~cells;", ";"),
    ("chains", "perception/local_grid_chain.cpp", "if (swept != 0) ahead.clip", "if (swept == 0) ahead.clip"),
    ("readings", "perception/range_conditioner.cpp", "s.oldest = recent(kNear - 1).taken;", "s.oldest = recent(kNear).taken;"),
    ("odometry", "localization/odometry.cpp", "difference_ += step.right - step.left;", "difference_ += step.right + step.left;"),
    ("coasting", "safety/coasting.cpp", "hold_us_(microseconds(longest_gap(params)))", "hold_us_(microseconds(params.safety.period))"),
    ("wheels", "safety/stall_watch.cpp", "for_ = min(for_ + elapsed,", "for_ = min(for_ + elapsed + elapsed,"),
    ("faults", "safety/supervisor.cpp", "count(health_.late_ticks);", ";"),
    ("manoeuvres", "planning/motion_controller.cpp", "kStillPeriods = 3;", "kStillPeriods = 3000;"),
    ("loops", "planning/boundary/loop_detector.cpp", "lap_at_ = view.pose.at;", ";"),
    ("base", "can/base_node.cpp", "command_seen_ = now_ms();", ";"),
    ("reports", "can/base_node.cpp", "trust_come_ = false;", ";"),
    ("controller", "can/controller_node.cpp", "count(tally().skipped);", ";"),
    ("orders", "can/controller_node.cpp", "if (!orders_.complete(order)) return MissionStatus::incomplete;", ";"),
    ("guarded", "guard.cpp", "const bool doubted = limited.forward != wanted.forward;", "const bool doubted = false;"),
    ("broken", "guard.cpp", "now - commanded_at_ <= params_.guard.command_timeout", "now - commanded_at_ >= params_.guard.command_timeout"),
    ("missions", "chassis.cpp", "since_counts_ += safety::braking_time(params_);", ";"),
    ("planners", "planning/thesis/step_probe.cpp", "aside > half ? aside - half : 0", "aside > half ? aside + half : 0"),
    ("senses", "planning/global/grid_map.cpp", "cell_um_ / 5 * 3", "cell_um_ / 5"),
    ("rules", "can/controller_node.cpp", "rules_replies_ = true;", ";"),
    ("guide", "planning/global/wavefront_planner.cpp", "++attempts_;", ";"),
)  # fmt: skip


def found(root, compiler, libraries, folder, part, file, old, new):
    """None if the judge complains, otherwise what is wrong."""
    source = root / "firmware" / file
    text = source.read_text()
    if old not in text:
        return f"{file} has no {old!r}"
    defect, program = folder / "defect.cpp", folder / part
    defect.write_text(text.replace(old, new, 1))
    build = [compiler, "-std=c++17", "-O1", "-w", "-fno-exceptions", f"-I{root}", f"-I{source.parent}"]
    subprocess.run([*build, defect, root / "tests/hunt/planted.cpp", *libraries, "-o", program], check=True)
    done = subprocess.run([program, part, "1", str(SEEDS)], stdout=subprocess.PIPE, text=True, timeout=300, check=False)
    print(f"{part:<12} {done.stdout.strip() or done.returncode}", flush=True)
    return None if done.returncode != 0 else f"{part}: nothing found in {SEEDS} cases of {file}: {new!r}"


def main():
    root, compiler, *libraries = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        wrong = [found(pathlib.Path(root), compiler, libraries, pathlib.Path(folder), *row) for row in PLANTED]
    wrong = list(filter(None, wrong))
    print("\n".join(wrong) or f"{len(PLANTED)} planted defects found")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
