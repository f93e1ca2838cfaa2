"""A ROS 2 node (rclpy) between a robot's topics and Whisker. Untested: nobody has run it yet.

Subscribes to sensor_msgs/Range on range/left, range/front and range/right, or to sensor_msgs/LaserScan on scan, of which each beam is a
sector (sectors.py, to be put beside this file; docs/socket.md has the premise), and to sensor_msgs/JointState on joint_states with the joints
left_wheel and right_wheel; publishes geometry_msgs/Twist on cmd_vel. Goals come as geometry_msgs/PoseStamped on goal_pose, in the frame of
the wheels' odometry. For Gazebo, bridge these topics with ros_gz_bridge. Start `whisker socket --tcp 7000` first.
"""

import json
import math
import socket

import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from rclpy.node import Node
from sectors import readings
from sensor_msgs.msg import JointState, LaserScan, Range

BEAMS = ("left", "front", "right")


class Whisker(Node):
    def __init__(self):
        super().__init__("whisker")
        self.wheel_radius_m = self.declare_parameter("wheel_radius_m", 0.03).value
        self.stream = socket.create_connection(("127.0.0.1", 7000)).makefile("rw", newline="\n")
        self.hello = self.ask({"whisker": 1})
        self.fresh = {}
        self.goal = self.counts = None
        for beam in BEAMS:
            self.create_subscription(Range, f"range/{beam}", lambda m, beam=beam: self.on_range(beam, m), 1)
        self.create_subscription(LaserScan, "scan", self.on_scan, 1)
        self.create_subscription(JointState, "joint_states", self.on_joints, 1)
        self.create_subscription(PoseStamped, "goal_pose", self.on_goal, 1)
        self.cmd_vel = self.create_publisher(Twist, "cmd_vel", 1)
        self.create_timer(self.hello["period_s"], self.tick)

    def ask(self, line):
        self.stream.write(json.dumps(line) + "\n")
        self.stream.flush()
        answer = json.loads(self.stream.readline())
        if "error" in answer:
            self.cmd_vel.publish(Twist())
            raise SystemExit(answer["error"])
        return answer

    def on_range(self, beam, message):
        # REP 117: infinite is clear, minus infinite too near, and no number a lost reading.
        r = message.range
        self.fresh[beam] = "invalid" if math.isnan(r) else "too_near" if r == -math.inf else "clear" if r > message.max_range else r

    def on_scan(self, message):
        first, step = math.degrees(message.angle_min), math.degrees(message.angle_increment)
        sectors = readings(message.ranges, first, step, message.range_min, self.hello["beams"])
        self.fresh = dict(zip(BEAMS, sectors))

    def on_joints(self, message):
        turned = dict(zip(message.name, message.position))
        per_rad = self.hello["encoder_counts_per_m"] * self.wheel_radius_m
        if {"left_wheel", "right_wheel"} <= turned.keys():
            self.counts = [math.floor(turned[f"{side}_wheel"] * per_rad) for side in ("left", "right")]

    def on_goal(self, message):
        self.goal = {"x_m": message.pose.position.x, "y_m": message.pose.position.y}

    def tick(self):
        line = {"range_m": [self.fresh.get(beam) for beam in BEAMS]}  # no t_s: the time of arrival counts
        if self.counts:
            line["counts"] = self.counts
        if self.goal:
            line["goal"] = self.goal
        self.fresh, self.goal = {}, None
        answer = self.ask(line)
        left, right = answer["wheel_mps"]
        twist = Twist()
        twist.linear.x = (left + right) / 2
        twist.angular.z = (right - left) / self.hello["wheel_track_m"]
        self.cmd_vel.publish(twist)


rclpy.init()
rclpy.spin(Whisker())
