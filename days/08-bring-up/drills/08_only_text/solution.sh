# Starts a talker. The listener must start only with ear:=true, and not here.

cat > "$HOME/pair.launch.py" <<'END'
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    ear = LaunchConfiguration("ear")
    return LaunchDescription([
        DeclareLaunchArgument("ear", default_value="true"),
        Node(package="demo_nodes_py", executable="talker"),
        Node(package="demo_nodes_py", executable="listener", condition=IfCondition(ear)),
    ])
END

ros2 launch "$HOME/pair.launch.py" ear:=false
