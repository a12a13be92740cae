"""Start the nodes of two rovers, each rover in a namespace of its own.

Do the TODOs in the order of their numbers. The names and the values that you need
stand on the card, in labs/bring-up/task.md.
"""

from pathlib import Path

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription

# TODO 13: import what you need: DeclareLaunchArgument and GroupAction from
#          launch.actions, IfCondition from launch.conditions, LaunchConfiguration
#          from launch.substitutions, Node and PushRosNamespace from
#          launch_ros.actions.

PACKAGE = 'rover_bringup'
VALUES = str(Path(get_package_share_directory(PACKAGE)) / 'config' / 'rovers.yaml')


def rover(name, condition=None):
    """All nodes of one rover."""
    # TODO 14: return a GroupAction with a list and with this condition. The list
    #          pushes the namespace, and starts both nodes of the package, each by
    #          its name of the card. One of them comes back when it was killed: the
    #          card says which. Both get parameters: a list with the file that the
    #          argument names, and behind it the value of careful.


def generate_launch_description():
    """Declare the arguments, and start both rovers."""
    return LaunchDescription(
        [
            # TODO 15: declare the three arguments of the card, with their defaults.
            #          The default of the first one is VALUES. Then call rover()
            #          twice; the second time with an IfCondition.
        ]
    )
