"""What a lesson's cell needs: a session, pictures of what runs, a verdict in colour, a quiz.

    from roslings.notebook import session, show_graph

rclpy and matplotlib are imported when they are first used. Importing this in a notebook makes its
errors short (see `errors`), and raises NoRos in a kernel without ROS.
"""

from __future__ import annotations

from roslings.notebook.errors import require_ros
from roslings.notebook.tracebacks import install

install()
require_ros()  # before all that needs more than plain Python: a wrong kernel may have no more

from roslings.notebook.graph import show_graph  # noqa: E402
from roslings.notebook.image import show_image  # noqa: E402
from roslings.notebook.intervals import plot_intervals  # noqa: E402
from roslings.notebook.programs import terminal  # noqa: E402
from roslings.notebook.qos_table import qos_table  # noqa: E402
from roslings.notebook.quiz import quiz  # noqa: E402
from roslings.notebook.rover_map import show_map, show_path  # noqa: E402
from roslings.notebook.session import Session, session  # noqa: E402
from roslings.notebook.verdict import check  # noqa: E402
from roslings.notebook.watching import watch_topic  # noqa: E402

__all__ = [
    "Session",
    "check",
    "plot_intervals",
    "qos_table",
    "quiz",
    "session",
    "show_graph",
    "show_image",
    "show_map",
    "show_path",
    "terminal",
    "watch_topic",
]
