"""What the base gives the wheels in real time: the controller's commands while they come, and a ramp to a stand."""

import time

from base import COMMAND_LATE, RUNNING

OLD_MS, LATE_S = 50, 0.049  # a command's measurements; no command
RAMP = 100  # of 0.1 mm/s in a period: 1 m/s2


class Wheels:
    def __init__(self, base, period_ms):
        self.base, self.period_ms = base, period_ms
        self.left = self.right = 0
        self.begin()

    def begin(self):
        """An order was accepted: what was commanded before does not count."""
        self.command = None
        self.heard_at = time.monotonic()

    def hear(self, tick):
        """Looks for a command while the set of this tick is the last one."""
        command = self.base.heard.pop("WheelCommand", None)
        behind = (tick - command["Tick"]) % 65536 if command else 0
        if command and (command["Mode"] == 0 or behind * self.period_ms <= OLD_MS):
            self.command, self.heard_at = command, time.monotonic()
        elif time.monotonic() - self.heard_at > LATE_S:
            self.base.stop(COMMAND_LATE)

    def speeds(self):
        """Left and right for the next period."""
        if self.base.state == RUNNING and self.command and self.command["Mode"] == 1:
            self.left, self.right = self.command["Left"], self.command["Right"]
        else:
            fastest = max(abs(self.left), abs(self.right))
            kept = max(0, fastest - RAMP)
            self.left, self.right = (int(speed * kept / fastest) if kept else 0 for speed in (self.left, self.right))
        return self.left, self.right

    def at_rest(self):
        return self.left == self.right == 0
