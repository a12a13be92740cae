"""What a lesson's cell needs: a session, pictures of what runs, a verdict in colour, a quiz.

    from roslings_learn.notebook import session, show_graph

rclpy and matplotlib are imported when they are first used. Importing this in a notebook makes its
errors short (see `errors`), and raises NoRos in a kernel without ROS.
"""

from __future__ import annotations

from roslings_learn.notebook.errors import require_ros
from roslings_learn.notebook.tracebacks import install

install()
require_ros()  # before all that needs more than plain Python: a wrong kernel may have no more

from roslings_learn.notebook.desk import desk  # noqa: E402
from roslings_learn.notebook.graph import show_graph  # noqa: E402
from roslings_learn.notebook.image import show_image  # noqa: E402
from roslings_learn.notebook.intervals import plot_intervals  # noqa: E402
from roslings_learn.notebook.programs import terminal  # noqa: E402
from roslings_learn.notebook.qos_table import qos_table  # noqa: E402
from roslings_learn.notebook.quiz import quiz  # noqa: E402
from roslings_learn.notebook.rover_map import show_map, show_my_rover, show_path  # noqa: E402
from roslings_learn.notebook.scans import show_grid, show_scans  # noqa: E402
from roslings_learn.notebook.session import Session, session  # noqa: E402
from roslings_learn.notebook.verdict import check  # noqa: E402
from roslings_learn.notebook.watching import watch_topic  # noqa: E402

__all__ = [
    "Session",
    "check",
    "desk",
    "plot_intervals",
    "qos_table",
    "quiz",
    "session",
    "show_graph",
    "show_grid",
    "show_image",
    "show_map",
    "show_my_rover",
    "show_path",
    "show_scans",
    "terminal",
    "watch_topic",
]
