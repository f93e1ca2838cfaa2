"""Reads the compilers' and linkers' reports on an image: section sizes by stage of the core, and the deepest call chain."""

import collections
import pathlib
import re
import subprocess

import chips

FLASH = (".text", ".rodata", ".data")
RAM = (".data", ".bss")

# The possible targets of each indirect call; an indirect call missing here is an error.
INDIRECT = (
    (
        r"Robot(4plan|11ask_planner|8localize|11follow_wall|8perceive|8set_goal|6cancel|5reset|5aimed|9aim_again|7correct|8put_down|5place|4tick)E",
        r"8planning11GoalPlanner(4stepE|8set_goalE|9move_goalE|6cancelE)",
    ),
    (r"Robot(6ponder|4tick)E", r"8planning(15BoundaryPlanner|7Planner)6ponderE"),
    (r"8planning11GoalPlanner6answerE", r"8planning(15BoundaryPlanner|13ThesisPlanner)(5startE|7advanceE)"),
    (r"8planning11GoalPlanner9move_goalE", r"8planning(11GoalPlanner|15BoundaryPlanner)11follow_goalE"),
    (r"8planning6Course", r"8planning15TableDeflection7deflectE"),
    # The linker merges the empty read functions into one.
    (r"Chassis(5sense|11take_counts)E|Robot(8perceive|4tick|8localize)E", r"4readER.*(13RangeReadings|13EncoderCounts)E"),
    (r"Robot10take_bumpsE", r"4readER.*13BumperReadingE"),
    (r"Chassis11take_countsE|Robot8localizeE", r"4readER.*11GyroReadingE"),
    (r"Chassis11take_countsE|Robot8localizeE", None),  # most images have no gyro
    (r"Robot10take_bumpsE", None),  # most images have no bump switch
    (r"10WheelDrive4readE", r"4readER.*(13RangeReadings|13EncoderCounts)E"),
    (r"10WheelDrive7commandE|Chassis7actuateE|Robot(7actuate|4tick)E", r"7commandE.*11WheelSpeedsE"),
)  # fmt: skip
NO_GUIDE = ((r"NK?7whisker8planning(15BoundaryPlanner|8Approach)", None),)
# The boundary planner with a map.
GUIDE = ((r"NK?7whisker8planning(15BoundaryPlanner|8Approach)", r"N7whisker8planning16WavefrontPlanner(5start|9move_goal|7observe|6ponder|6advise|6refuse|5doubt)E|WavefrontPlanner12knows_no_way"),)
# The controller on a bus: node, port and line.
NODE = (
    (r"3can4Node10understandE", r"ControllerNode8on_frameE"),
    (r"3can(4Node|14ControllerNode|8BusGuard)", r"ControllerNode(10reset_peerE|7at_restE|5timedE)|5slcan5Slcan(4sendE|7receiveE|4pollE|7restartE|5stateE|6countsE)"),
    (r"5slcan5Slcan", r"8UartPort.*(4takeE|5offerE|5readyE)"),
    (r"11RemoteRobot7executeE", r"8Planners4makeE"),
    (r"5fuzzy10TableStore|7storage9read_wordE", None),  # no storage
    (r"7can_app10Controller4saveE", None),  # no calibrator
    (r"^main$", r"12Milliseconds.*6now_msE|8UartPort.*4takeE|12CounterMeter.*5stampE"),
)  # fmt: skip

# Stack of libgcc's helpers, read from their code; they have no call graph.
HELPER_BYTES = {"cortex-m0plus": 112}
OTHER_HELPER_BYTES = 56


def stages():
    """Base name of each core source -> its stage."""
    found = {}
    for path in sorted((chips.ROOT / "firmware").rglob("*.cpp")):
        parts = path.relative_to(chips.ROOT / "firmware").parts
        found[path.name] = parts[0] if len(parts) > 1 else "robot"
    return found


def sections(map_file):
    """(input section, bytes, object) of each section that the linker kept."""
    text = pathlib.Path(map_file).read_text()
    text = text[text.index("Linker script and memory map") :].split("/DISCARD/")[0]
    pattern = r"^ (\.[\w.$*]+|COMMON)\s+0x([0-9a-f]+)\s+0x([0-9a-f]+) (\S+)$"
    for name, address, size, origin in re.findall(pattern, text, re.MULTILINE):
        if int(size, 16) and int(address, 16) or name.startswith(".vectors"):
            yield name, int(size, 16), origin


def sizes(image, prefix):
    """Bytes of flash, and of RAM without the stack, of a linked image."""
    text = subprocess.run([f"{prefix}size", image], capture_output=True, text=True, check=True).stdout
    code, data, bss = map(int, text.splitlines()[1].split()[:3])
    return code + data, data + bss


def weigh(map_file, ram_sections=RAM):
    """Bytes of flash and RAM by stage; code outside the core counts as 'helpers' (libgcc) or 'rest'."""
    known = stages()
    flash, ram = collections.Counter(), collections.Counter()
    namespace = re.compile(r"_Z\w*?7whisker(?:\d+(" + "|".join(set(known.values())) + r")\d)?")
    for name, size, origin in sections(map_file):
        member = re.search(r"\((\w+\.cpp)\.obj\)$", origin)
        of_core = member and "whisker_core" in origin
        stage = known.get(member[1], "rest") if of_core else "helpers" if "libgcc" in origin else "rest"
        named = namespace.search(name)
        if stage == "rest" and named:
            # Functions defined in the core's headers lie in the first object that uses them.
            stage = named[1] or "rest"
        if name.startswith(FLASH):
            flash[stage] += size
        if name.startswith(ram_sections) or name == "COMMON":
            ram[stage] += size
    return flash, ram


class CallGraph:
    """The call graph in the .ci files of -fcallgraph-info=su."""

    def __init__(self, files, helper_bytes, indirect):
        self.own, self.calls = {}, collections.defaultdict(set)
        self.helper_bytes, self.indirect = helper_bytes, indirect
        for path in files:
            text = path.read_text()
            for title, label in re.findall(r'^node: \{ title: "([^"]+)" label: "([^"]*)"', text, re.MULTILINE):
                size = re.search(r"(\d+) bytes \((\w+)", label)
                if size:
                    if size[2] != "static":
                        raise ValueError(f"{title}: its stack is not static")
                    self.own[title] = max(self.own.get(title, 0), int(size[1]))
            for source, target in re.findall(r'sourcename: "([^"]+)" targetname: "([^"]+)"', text):
                self.calls[source].add(target)
        self.instances = {title.rpartition(":")[2]: title for title in self.own if ":" in title}

    def targets(self, caller):
        for called in self.calls[caller]:
            if called != "__indirect_call":
                yield called
                continue
            rules = [where for who, where in self.indirect if re.search(who, caller)]
            found = [f for f in self.own if any(where and re.search(where, f) for where in rules)]
            if not found and None not in rules:
                raise ValueError(f"{caller} calls by a table, and nobody says what")
            yield from found

    def deepest(self, root):
        """(bytes, functions) of the deepest call chain from the function of this name."""
        if root not in self.own:
            raise ValueError(f"{root}: not in the call graph")
        return self._deepest(root, {}, ())

    def _deepest(self, function, done, above):
        if function in above:
            raise ValueError(f"{function} calls itself: no bound")
        if function not in done:
            best = (0, ())
            for called in self.targets(function):
                # A constructor has two symbol names for one function.
                called = called if called in self.own else re.sub(r"C1E", "C2E", called)
                # An instance of a template has, in the object that defines it, the file before its name.
                called = self.instances.get(called, called) if called not in self.own else called
                if called in self.own:
                    best = max(best, self._deepest(called, done, (*above, function)))
                elif re.fullmatch(r"__\w+|mem\w+", called):
                    best = max(best, (self.helper_bytes, (called,)))
                else:
                    raise ValueError(f"{called}: not in the call graph")
            done[function] = (self.own[function] + best[0], (function, *best[1]))
        return done[function]


def graph_of(build, folders, image, indirect):
    folder = chips.BUILD / build
    programs = folder / "firmware/apps/CMakeFiles"
    unused = (programs, folder / "firmware/CMakeFiles/whisker_c.dir")  # no image calls the interface for C
    files = [path for name in folders for path in (folder / name).rglob("*.ci") if not {*unused} & {*path.parents}]
    files += programs.glob(f"{image}.dir/**/*.ci")
    return CallGraph(files, HELPER_BYTES.get(build, OTHER_HELPER_BYTES), indirect)


def core_stack(build, image="bare", guide=NO_GUIDE):
    """(worst-case stack of Robot::tick in bytes, its call chain)"""
    return graph_of(build, ["firmware"], image, INDIRECT + guide).deepest("_ZN7whisker5Robot4tickENS_4TimeE")


def map_stack(build):
    """The same with the map planner."""
    return core_stack(build, "bare-map", GUIDE)


def node_stack(build, image):
    """(worst-case stack of a complete controller on a bus, from start-up, in bytes, its call chain). It enables no
    interrupt."""
    return graph_of(build, ["firmware", "hal"], image, INDIRECT + GUIDE + NODE).deepest("reset")
