"""How the rover is when it is healthy: its topics, and what each of them says."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class TopicSheet:
    """One topic of the healthy rover."""

    name: str
    type: str
    node: str
    rate_hz: float
    frame: str
    """Its frame_id; empty for a type without a header."""
    value: str
    """The field that tells its value, with what it may be."""
    asks_reliable: bool
    """Whether who hears it asks for reliable."""
    offers_reliable: bool
    """What is offered may be better than what is asked for."""

    @property
    def stamped(self) -> bool:
        """It has a header."""
        return bool(self.frame)


CMD_VEL = TopicSheet(
    "/cmd_vel",
    "geometry_msgs/msg/Twist",
    "/pilot",
    10.0,
    "",
    "`linear.x`, 0 to 0.30 m/s",
    asks_reliable=True,
    offers_reliable=True,
)
WHEEL_SPEEDS = TopicSheet(
    "/wheel_speeds",
    "sensor_msgs/msg/JointState",
    "/base",
    20.0,
    "base_link",
    "`velocity`, -20 to 20 rad/s",
    asks_reliable=False,
    offers_reliable=True,
)
ODOM = TopicSheet(
    "/odom",
    "nav_msgs/msg/Odometry",
    "/base",
    20.0,
    "odom",
    "`twist.twist.linear.x`, as fast as the wheels turn, in m/s",
    asks_reliable=True,
    offers_reliable=True,
)
IMU = TopicSheet(
    "/imu",
    "sensor_msgs/msg/Imu",
    "/imu_driver",
    50.0,
    "imu_link",
    "`angular_velocity.z`, -1 to 1 rad/s",
    asks_reliable=False,
    offers_reliable=False,
)
RANGE = TopicSheet(
    "/range",
    "sensor_msgs/msg/Range",
    "/range_driver",
    10.0,
    "range_link",
    "`range`, 0.2 to 3 m",
    asks_reliable=False,
    offers_reliable=False,
)
BATTERY = TopicSheet(
    "/battery",
    "sensor_msgs/msg/BatteryState",
    "/battery_monitor",
    4.0,
    "base_link",
    "`voltage`, 6 to 8.4 V",
    asks_reliable=True,
    offers_reliable=True,
)
TEMPERATURE = TopicSheet(
    "/temperature",
    "sensor_msgs/msg/Temperature",
    "/thermometer",
    5.0,
    "motor_link",
    "`temperature`, 20 to 45 °C",
    asks_reliable=True,
    offers_reliable=True,
)
LIGHT = TopicSheet(
    "/light",
    "sensor_msgs/msg/Illuminance",
    "/light_sensor",
    5.0,
    "mast_link",
    "`illuminance`, 100 to 600 lx",
    asks_reliable=True,
    offers_reliable=True,
)
BUMPER = TopicSheet(
    "/bumper",
    "std_msgs/msg/Bool",
    "/bumper_driver",
    8.0,
    "",
    "`data`, true or false",
    asks_reliable=True,
    offers_reliable=True,
)

SHEET = (CMD_VEL, WHEEL_SPEEDS, ODOM, IMU, RANGE, BATTERY, TEMPERATURE, LIGHT, BUMPER)
MAX_SPEED_M_S = 0.30
"""What the parameter of the pilot is set to."""
