"""The checks, by theme. Importing this package registers them.

The order of the imports is the order of mending. The computer comes before ROS, ROS before the
shell, the shell before the network, and so on to the notebook.
"""

from ros_doctor.checks import computer  # isort: skip
from ros_doctor.checks import install  # isort: skip
from ros_doctor.checks import shell  # isort: skip
from ros_doctor.checks import network  # isort: skip
from ros_doctor.checks import live  # isort: skip
from ros_doctor.checks import workspace  # isort: skip
from ros_doctor.checks import hardware  # isort: skip
from ros_doctor.checks import desktop  # isort: skip
from ros_doctor.checks import notebook  # isort: skip

THEMES = (computer, install, shell, network, live, workspace, hardware, desktop, notebook)
