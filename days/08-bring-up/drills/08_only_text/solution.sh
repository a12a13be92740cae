# Starts a talker. A listener only comes with ear:=true; else launch says "no listener today".

cd "$(mktemp -d)"    # a new, empty folder
cat > pair.launch.py <<'END'
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    ear = LaunchConfiguration("ear")
    return LaunchDescription([
        DeclareLaunchArgument("ear", default_value="true"),
        Node(package="demo_nodes_py", executable="talker"),
        Node(package="demo_nodes_py", executable="listener", condition=IfCondition(ear)),
        LogInfo(msg="no listener today", condition=UnlessCondition(ear)),
    ])
END

ros2 launch pair.launch.py ear:=false
