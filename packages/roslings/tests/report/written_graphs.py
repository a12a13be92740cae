"""ROS graphs written by hand, as a probe would see them."""

from __future__ import annotations

from collections.abc import Iterable

from pydantic import TypeAdapter

from roslings.evidence import Endpoint, GraphSeen, Qos

STRING = "std_msgs/msg/String"
TWIST = "geometry_msgs/msg/Twist"
SCAN = "sensor_msgs/msg/LaserScan"
IMAGE = "sensor_msgs/msg/Image"
ODOMETRY = "nav_msgs/msg/Odometry"

Link = tuple[str, str, str]  # node, topic, type


def graph(
    publishes: Iterable[Link] = (), subscribes: Iterable[Link] = (), nodes: Iterable[str] = ()
) -> GraphSeen:
    """These endpoints, and what rclpy gives to every node; `nodes` are nodes besides."""
    ends = [
        *(_end("publisher", *link) for link in publishes),
        *(_end("subscription", *link) for link in subscribes),
    ]
    names = [*dict.fromkeys(end.node for end in ends), *nodes]
    usual = [
        end
        for name in names
        for end in (
            _end("publisher", name, "/rosout", "rcl_interfaces/msg/Log"),
            _end("publisher", name, "/parameter_events", "rcl_interfaces/msg/ParameterEvent"),
        )
    ]
    return GraphSeen(nodes=names, endpoints=ends + usual)


def _end(kind: str, node: str, topic: str, type_name: str) -> Endpoint:
    return TypeAdapter(Endpoint).validate_python(
        {"kind": kind, "node": node, "topic": topic, "type": type_name, "qos": Qos(), "gid": "00"}
    )


def empty() -> GraphSeen:
    """Nothing runs."""
    return GraphSeen(nodes=[], endpoints=[])


def one() -> GraphSeen:
    """A talker alone."""
    return graph([("/talker", "/chatter", STRING)])


def two() -> GraphSeen:
    """The lab's own graph."""
    return graph([("/talker", "/chatter", STRING)], [("/listener", "/chatter", STRING)])


def five() -> GraphSeen:
    """Two robots, a node twice, a node alone, and two types on one topic."""
    return graph(
        [
            ("/robot1/camera", "/robot1/image_raw", IMAGE),
            ("/talker", "/chatter", STRING),
            ("/talker", "/chatter", "std_msgs/msg/Int32"),
        ],
        [("/robot1/viewer", "/robot1/image_raw", IMAGE), ("/listener", "/chatter", STRING)],
        nodes=["/talker", "/idle"],
    )


def loop() -> GraphSeen:
    """A controller and a robot that feed each other, and a node that hears itself."""
    return graph(
        [
            ("/controller", "/cmd_vel", TWIST),
            ("/robot", "/odom", ODOMETRY),
            ("/echo", "/echo_topic", STRING),
        ],
        [
            ("/robot", "/cmd_vel", TWIST),
            ("/controller", "/odom", ODOMETRY),
            ("/echo", "/echo_topic", STRING),
        ],
    )


def twelve() -> GraphSeen:
    """A rover: 12 nodes, 20 topics, feedback."""
    return graph(
        [
            ("/camera", "/camera/image_raw", IMAGE),
            ("/camera", "/camera/camera_info", "sensor_msgs/msg/CameraInfo"),
            ("/lidar", "/scan", SCAN),
            ("/imu", "/imu/data_raw", "sensor_msgs/msg/Imu"),
            ("/imu_filter", "/imu/data", "sensor_msgs/msg/Imu"),
            ("/wheel_encoders", "/joint_states", "sensor_msgs/msg/JointState"),
            ("/odometry", "/odom", ODOMETRY),
            ("/odometry", "/tf", "tf2_msgs/msg/TFMessage"),
            ("/detector", "/detections", "vision_msgs/msg/Detection2DArray"),
            ("/detector", "/camera/debug_image", IMAGE),
            ("/mapper", "/map", "nav_msgs/msg/OccupancyGrid"),
            ("/planner", "/plan", "nav_msgs/msg/Path"),
            ("/planner", "/planner/costmap", "nav_msgs/msg/OccupancyGrid"),
            ("/controller", "/cmd_vel", TWIST),
            ("/teleop", "/cmd_vel", TWIST),
            ("/teleop", "/emergency_stop", "std_msgs/msg/Bool"),
            ("/base", "/battery", "sensor_msgs/msg/BatteryState"),
            ("/base", "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),
            ("/lidar", "/diagnostics", "diagnostic_msgs/msg/DiagnosticArray"),
            ("/base", "/motor_ticks", "std_msgs/msg/Int32MultiArray"),
            ("/controller", "/controller/error", "std_msgs/msg/Float64"),
        ],
        [
            ("/detector", "/camera/image_raw", IMAGE),
            ("/detector", "/camera/camera_info", "sensor_msgs/msg/CameraInfo"),
            ("/imu_filter", "/imu/data_raw", "sensor_msgs/msg/Imu"),
            ("/odometry", "/imu/data", "sensor_msgs/msg/Imu"),
            ("/odometry", "/joint_states", "sensor_msgs/msg/JointState"),
            ("/mapper", "/scan", SCAN),
            ("/mapper", "/odom", ODOMETRY),
            ("/mapper", "/tf", "tf2_msgs/msg/TFMessage"),
            ("/planner", "/map", "nav_msgs/msg/OccupancyGrid"),
            ("/planner", "/detections", "vision_msgs/msg/Detection2DArray"),
            ("/planner", "/goal_pose", "geometry_msgs/msg/PoseStamped"),
            ("/controller", "/plan", "nav_msgs/msg/Path"),
            ("/controller", "/odom", ODOMETRY),
            ("/controller", "/scan", SCAN),
            ("/base", "/cmd_vel", TWIST),
            ("/base", "/emergency_stop", "std_msgs/msg/Bool"),
            ("/wheel_encoders", "/motor_ticks", "std_msgs/msg/Int32MultiArray"),
        ],
    )


def long_names() -> GraphSeen:
    """Names that no label holds on one line, and letters that are not ASCII."""
    node = "/building_seven/second_floor/very_long_robot_name_number_42/navigation/controller"
    topic = "/" + "x" * 70
    return graph(
        [(node, topic, "my_very_long_package_name_interfaces/msg/VeryLongMessageName")],
        [("/zuhörer_名前_слушатель", topic, STRING)],
    )
