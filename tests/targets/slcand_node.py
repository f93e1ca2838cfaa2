"""The core on an emulated chip, with SLCAN on its UART, becomes an ordinary CAN interface through slcand and Linux's
driver in the micro-VM. The plant drives over it, candump records, and the commands equal those of the core in process.

usage: slcand_node.py ROOT WHISKER
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

SECONDS = 5  # of the drive
LIMIT_S = 400
PATIENCE_S = 10  # with the emulator
TRAP = "host/worlds/scenarios/figure8_u_trap.toml"

# WHISKER TRAP SECONDS: prints one JSON object per line.
PROGRAM = r"""
slcand -F -o -s6 /dev/hvc0 slcan0 &
until ip link set slcan0 up 2>/dev/null; do sleep 0.1; done
candump -r 4000000 -L slcan0 >/tmp/candump.log &
candump=$!
until grep -q "slcan0 .* raw" /proc/net/can/rcvlist_all; do sleep 0.1; done
{ echo "time_limit_s = $3"; cat "$2"; } >/tmp/trap.toml
"$1" run /tmp/trap.toml --json
"$1" plant /tmp/trap.toml --can slcan0 --json
kill "$candump"
wait "$candump"
"$1" replay /tmp/candump.log --json
"""


def wait_for(socket, chip):
    end = time.monotonic() + PATIENCE_S
    while not socket.is_socket():
        if chip.poll() is not None or time.monotonic() > end:
            raise RuntimeError("the emulator opens no socket")
        time.sleep(0.05)


def main(root, whisker):
    root = pathlib.Path(root)
    with tempfile.TemporaryDirectory(prefix="whisker-slcand-") as folder:
        socket = pathlib.Path(folder, "node.sock")
        chip = subprocess.Popen([root / "scripts/chip", "cortex-m3", "can-node", "--socket", socket])
        try:
            wait_for(socket, chip)
            command = [root / "scripts/with-vcan", "--timeout", LIMIT_S, "--tty", socket, "bash", "-c", PROGRAM, "bash"]
            command += [whisker, root / TRAP, SECONDS]
            done = subprocess.run([str(part) for part in command], cwd=root, capture_output=True, text=True, check=False)
        finally:
            chip.terminate()
            chip.wait(PATIENCE_S)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    if len(lines) != 3:
        print(f"slcand-node: exit status {done.returncode}: {done.stdout}{done.stderr}")
        return 1
    here, there, heard = lines
    print(f"slcand-node: {here['ticks']} ticks, {there['bus']['ticks_per_s']} a second; here {here['hash']}, there {there['hash']}, heard {heard['hash']}")
    return 0 if heard["same"] and here["ticks"] == there["ticks"] == heard["steps"] and here["hash"] == there["hash"] == heard["hash"] else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
