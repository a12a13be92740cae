"""The names of windows that are typed without `ros2 run`; an environment has them on its path."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from functools import partial

from ros2_on_pip.cli import STOPPED, explained
from ros2_on_pip.handover import hand_over
from ros2_on_pip.well_known import absent
from ros2_on_pip.windows import WindowReplacement, command_for, window_of
from ros2_on_pip.words import WRONG_USE


def main(name: str, argv: Sequence[str]) -> int:
    """Become the real command where there is one, else open its window, else say what to use."""
    hand_over(name, f"{name}.main", argv)
    if window := window_of(name):
        return _opened(window, argv)
    told = absent(name)
    assert told is not None, name
    print("\n".join(filter(None, [told.told(name), command_for(name)])), file=sys.stderr)
    return WRONG_USE


def _opened(window: WindowReplacement, argv: Sequence[str]) -> int:
    try:
        return explained(lambda: window.open(argv))
    except KeyboardInterrupt:
        return STOPPED


rqt = partial(main, "rqt")
rqt_console = partial(main, "rqt_console")
rqt_image_view = partial(main, "rqt_image_view")
rqt_plot = partial(main, "rqt_plot")
rqt_publisher = partial(main, "rqt_publisher")
rqt_reconfigure = partial(main, "rqt_reconfigure")
rqt_topic = partial(main, "rqt_topic")
