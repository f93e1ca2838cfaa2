"""Checks that the body moves as a differential drive can. Each check yields complaints."""

import math


def check_start(scenario, trace):
    row = trace.rows[0]
    off = math.dist(row.at, scenario.start)
    if row.t != 0:
        yield f"row 0: the trace begins at {row.t} s"
    if off > trace.position_unit:
        yield f"row 0: {off:.6f} m from the start"
    if abs(math.remainder(row.heading - scenario.heading, math.tau)) > 2 * trace.unit["heading_rad"]:
        yield f"row 0: the heading is {row.heading}, not {scenario.heading:.6f} rad"
    if row.v_left or row.v_right:
        yield "row 0: the wheels turn already"


def check_wheels(scenario, trace, outcome):
    """Row period, speed and acceleration. On contact, and on a bump, the wheels stop at once."""
    robot = scenario.robot
    period, top = robot["control_period_s"], robot["wheel_speed_max_mps"]
    half = trace.unit["v_left_mps"] / 2
    for i, row in enumerate(trace.rows):
        fastest = max(abs(row.v_left), abs(row.v_right))
        if fastest > top + 1.01 * half:
            yield f"row {i}: a wheel turns at {fastest} m/s; at most {top}"
        if i == 0:
            continue
        before = trace.rows[i - 1]
        if abs(row.t - before.t - period) > 1e-9:
            yield f"row {i}: {row.t - before.t:.6f} s after the row before, not {period}"
        if row.pressed or (outcome == "contact" and i == len(trace.rows) - 1):
            continue
        change = max(abs(row.v_left - before.v_left), abs(row.v_right - before.v_right))
        if change > robot["wheel_acceleration_max_mps2"] * period + 2.02 * half:
            yield f"row {i}: a wheel's speed changed by {change:.5f} m/s in one period"


def check_rolling(scenario, trace, outcome):
    """The pose is the integral of the wheels' speeds, without sideways motion.

    The second derivative of a speed is at most acceleration / lag, which bounds the error of the trapezoidal rule.
    """
    robot = scenario.robot
    dt, track, lag = robot["control_period_s"], robot["wheel_track_m"], robot["motor_lag_s"]
    top, acceleration = robot["wheel_speed_max_mps"], robot["wheel_acceleration_max_mps2"]
    bend = acceleration * dt * dt / 4
    if lag > 0:
        bend = min(bend, acceleration * dt**3 / (12 * lag))
    rolled_slack = bend + dt * trace.unit["v_left_mps"] / 2 + 1e-8
    place, angle = 1.5 * trace.position_unit, trace.unit["heading_rad"]
    last = len(trace.rows) - 1
    for i in range(1, len(trace.rows)):
        a, b = trace.rows[i - 1], trace.rows[i]
        dx, dy, turned = b.x - a.x, b.y - a.y, b.heading - a.heading
        if b.pressed or (outcome == "contact" and i == last):
            if math.hypot(dx, dy) > top * dt + place:
                yield f"row {i}: jumped {math.hypot(dx, dy):.6f} m into the contact"
            continue
        middle = a.heading + turned / 2
        ahead = dx * math.cos(middle) + dy * math.sin(middle)
        aside = dy * math.cos(middle) - dx * math.sin(middle)
        left, right = (a.v_left + b.v_left) / 2 * dt, (a.v_right + b.v_right) / 2 * dt
        if abs(turned - (right - left) / track) > 2 * rolled_slack / track + angle:
            yield f"row {i}: turned {turned:.6f} rad where the wheels give {(right - left) / track:.6f}"
        if abs(ahead - (left + right) / 2) > rolled_slack + place + top * dt * turned * turned / 24:
            yield f"row {i}: went {ahead:.6f} m where the wheels give {(left + right) / 2:.6f}"
        uneven = top * dt * (angle + acceleration * dt * dt / (4 * track))
        if abs(aside) > place + uneven + acceleration * dt * dt * abs(turned) / 12:
            yield f"row {i}: slid {aside:.6f} m sideways"
