"""The names that books use for the windows of rqt, and the tab of the desk that does the same.

Imports nothing that is large: `ros2 run rqt_plot rqt_plot` asks here also where no desk is
installed.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.util import find_spec

from ros2_on_pip.absent import is_of_the_course
from ros2_on_pip.errors import OK
from roslings_desk.shown import TAKE_WORDS

HELP = ("-h", "--help")
ONE_PLUGIN = ("-s", "--standalone")
"""The option of the real `rqt` that shows one of its windows alone."""
ROS_ARGUMENTS, THEIR_END = "--ros-args", "--"


@dataclass(frozen=True)
class DeskTabWindow:
    """A tab of the desk, by the name of a window. `ros2_on_pip.windows` asks for it."""

    tab: str

    @property
    def is_here(self) -> bool:
        """The desk is installed by the first `./roslings desk`."""
        return find_spec("nicegui") is not None

    @property
    def command(self) -> str:
        """Only a course has the script."""
        return f"./roslings desk {self.tab}" if is_of_the_course() else ""

    def open(self, argv: Sequence[str]) -> int:
        """Serve the desk until Ctrl-C."""
        from roslings_desk.server import DeskOptions, run

        if set(HELP) & set(argv):
            print(self._help())
            return OK
        tab, words, left_out = self.read(argv)
        if left_out:
            print(f"The desk leaves out: {' '.join(left_out)}", file=sys.stderr)
        run(DeskOptions(tab, shown=tuple(words)))
        return OK

    def read(self, argv: Sequence[str]) -> tuple[str, list[str], list[str]]:
        """The tab, the words that it takes, and those that it has no use for."""
        tab, words, left_out = self.tab, list[str](), list[str]()
        rest = iter(argv)
        for word in rest:
            if word in ONE_PLUGIN:
                tab = _tab_of_plugin(next(rest, ""), tab)
            elif word == ROS_ARGUMENTS:
                left_out += [word, *_to_the_end(rest)]
            else:
                (left_out if word.startswith("-") else words).append(word)
        return (tab, words, left_out) if tab in TAKE_WORDS else (tab, [], [*left_out, *words])

    def _help(self) -> str:
        words = TAKE_WORDS.get(self.tab)
        takes = f"\nWhat it shows at once may stand behind it: {words}" if words else ""
        return f"Opens the tab '{self.tab}' of the desk in your browser. Ctrl-C closes it.{takes}"


def _tab_of_plugin(plugin: str, otherwise: str) -> str:
    """`rqt_plot`, `rqt_plot/Plot` and `rqt_plot.plot.Plot` are all one."""
    window = WINDOWS.get(plugin.replace("/", ".").partition(".")[0])
    return window.tab if window else otherwise


def _to_the_end(words: Iterator[str]) -> Iterator[str]:
    for word in words:
        yield word
        if word == THEIR_END:
            return


WINDOWS = {
    "rqt": DeskTabWindow("rover"),
    "rqt_action": DeskTabWindow("actions"),
    "rqt_console": DeskTabWindow("log"),
    "rqt_graph": DeskTabWindow("graph"),
    "rqt_gui": DeskTabWindow("rover"),
    "rqt_image_view": DeskTabWindow("image"),
    "rqt_plot": DeskTabWindow("plot"),
    "rqt_publisher": DeskTabWindow("topics"),
    "rqt_reconfigure": DeskTabWindow("parameters"),
    "rqt_robot_steering": DeskTabWindow("rover"),
    "rqt_service_caller": DeskTabWindow("services"),
    "rqt_tf_tree": DeskTabWindow("frames"),
    "rqt_topic": DeskTabWindow("topics"),
}
