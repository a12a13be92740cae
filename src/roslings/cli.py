"""Words and exit codes. Each command is a few lines that call a room.

Only the standard library is imported at the top, so that `./roslings --help` answers at once and
`./roslings doctor` runs where nothing is installed yet.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from roslings import __version__

OK, FAILED, WRONG_USE, INCONCLUSIVE, INTERRUPTED = 0, 1, 2, 3, 130
EXIT_OF_OUTCOME = {"pass": OK, "fail": FAILED, "inconclusive": INCONCLUSIVE}
SHAPES = {
    "junit": "a continuous integration server",
    "gradescope": "Gradescope (results.json)",
    "check50": "tools that read check50's JSON",
    "classroom": "GitHub Classroom's reporter (JSON)",
    "prairielearn": "PrairieLearn (results.json)",
    "vpl": "Moodle's Virtual Programming Lab",
}
"""Other shapes that a verdict is written in."""
EXIT_OF_ERROR = {
    "roslings.arena.lease:NoFreeDomain": INCONCLUSIVE,
    "roslings.arena.users:NoFreeUser": INCONCLUSIVE,
    "roslings.batch.crew:NurseryGone": INCONCLUSIVE,
    "roslings.batch.trouble:BatchError": WRONG_USE,
    "roslings.course.files:CourseError": WRONG_USE,
    "roslings.devices.trouble:DeviceTrouble": WRONG_USE,
    "roslings.experiment.measure:MeasuringFailed": INCONCLUSIVE,
    "roslings.experiment.walls:NoWall": WRONG_USE,
    "roslings.jupyter.trouble:NoLessonToOpen": WRONG_USE,
    "roslings.lessons.document:BadLessons": WRONG_USE,
    "roslings.report.evidence_file:BadEvidence": WRONG_USE,
    "roslings.report.evidence_folder:CannotKeepThere": WRONG_USE,
    "roslings.report.json_file:BadVerdictFile": WRONG_USE,
    "roslings.report.terminal:NoSuchCheck": WRONG_USE,
    "roslings.report.whole_file:CannotWrite": INCONCLUSIVE,
    "roslings.ros2.problem:Problem": WRONG_USE,
    "roslings.saving:NoBagWriter": WRONG_USE,
    "roslings.saving:NothingToSave": WRONG_USE,
    "roslings.workspace.trouble:MachineTrouble": INCONCLUSIVE,
    "roslings.workspace.trouble:WorkspaceError": WRONG_USE,
    "builtins:FileExistsError": WRONG_USE,
    "builtins:NotADirectoryError": WRONG_USE,
}
"""What a command may raise, by name: to import all these rooms takes longer than most commands."""
ONLY_IN_FULL = ("rqt", "rqt_console", "rqt_plot", "rviz2")
"""Commands of the full ROS that say what to use here, as `roslings.ros2.absent.COMMANDS`."""
Command = Callable[[argparse.Namespace], int]


def main(arguments: Sequence[str]) -> int:
    """Run one command; returns its exit code."""
    if arguments[:1] == ["doctor"]:
        from roslings.doctor.cli import main as doctor

        return doctor(list(arguments[1:]))
    if arguments[:1] == ["break"]:
        from roslings.doctor.breaks import main as break_it

        return break_it(list(arguments[1:]))
    if arguments[:1] == ["ros2"]:
        from roslings.ros2.cli import main as ros2

        return ros2(list(arguments[1:]))
    if arguments[:1] == ["rqt_graph"]:
        from roslings.ros2.rqt_graph import main as rqt_graph

        return rqt_graph(list(arguments[1:]))
    if arguments and arguments[0] in ONLY_IN_FULL:
        from roslings.ros2.absent import main as absent

        return absent(arguments[0], arguments[1:])
    options = parser().parse_args(
        ["test", "--", *arguments[1:]] if for_pytest(arguments) else arguments
    )
    return run(options.command, options)


def for_pytest(arguments: Sequence[str]) -> bool:
    """What follows `test` is pytest's, options too; only the help is ours."""
    return arguments[:1] == ["test"] and not {"-h", "--help"} & set(arguments)


def run(command: Command, options: argparse.Namespace) -> int:
    """Run a command; what it cannot do is one clear message, never a traceback of ours."""
    try:
        return command(options)
    except KeyboardInterrupt:
        print("\nStopped.", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        sys.stderr.close()  # nobody reads any more: end without a complaint
        return OK
    except Exception as error:
        return explain(error)


def explain(error: Exception) -> int:
    """Say what went wrong; the exit code tells whose fault it is. Raises what nobody expects."""
    code = exit_code_of(error)
    if code is None:
        raise error
    print(f"roslings: {error}", file=sys.stderr)
    return code


def exit_code_of(error: Exception) -> int | None:
    """The exit code for what went wrong; None for what nobody expected.

    A narrower kind counts before a wider one: MachineTrouble is a WorkspaceError too.
    """
    kinds = (f"{kind.__module__}:{kind.__qualname__}" for kind in type(error).__mro__)
    return next((EXIT_OF_ERROR[kind] for kind in kinds if kind in EXIT_OF_ERROR), None)


def command(name: str) -> Command:
    """A command of the module `commands`, imported when it is run."""

    def call(options: argparse.Namespace) -> int:
        from roslings import commands

        chosen: Command = getattr(commands, name)
        return chosen(options)

    return call


def parser() -> argparse.ArgumentParser:
    """Every command and its options."""
    top = argparse.ArgumentParser(
        prog="./roslings", description="Learn ROS 2 Jazzy in seven days.", allow_abbrev=False
    )
    top.add_argument("--version", action="version", version=f"roslings {__version__}")
    top.set_defaults(command=command("today"))
    words = top.add_subparsers(title="commands", metavar="COMMAND")
    add = Adder(words)
    add("doctor", "is this machine ready?", None)
    add("break", "ten small faults to find and mend with the doctor", None)
    add("status", "which days and labs are done", "status")
    lab_options(add("start", "put a lab's starter into your workspace", "start"))
    check_options(add("check", "run what you built, and say what to do next", "check"))
    regrade_options(add("regrade", "judge saved evidence again; runs nothing", "regrade"))
    grade_options(add("grade", "grade many submissions (for instructors)", "grade_all"))
    override_options(add("override", "give a score by hand, with its reason", "override"))
    watch_options(add("watch", "check again at every save", "watch"))
    lab_options(add("diff", "what you changed since the starter", "diff"))
    pack_options(add("pack", "make the zip file to hand in", "pack"))
    graph_options(add("graph", "show the running graph, or save a picture of it", "graph"))
    jupyter_options(add("lab", "open the day's lesson in JupyterLab", "lab"))
    site_options(add("site", "build the website: lessons, words, quizzes", "site"))
    test_options(add("test", "run the tests of roslings", "test"))
    rover_options(add("rover", "a small robot to drive by ROS, and its map", "rover"))
    board_options(add("board", "the rover's Arduino board on a serial port", "board"))
    camera_options(add("camera", "the rover's camera, for a node to read", "camera"))
    new_lab_options(add("new-lab", "make a small lab that works, to change it", "new_lab"))
    prove_options(add("prove", "show that a lab's checks catch what they should", "prove"))
    release_options(add("release", "make the students' edition, without solutions", "release"))
    export_options(add("export", "what a grading platform needs for a lab", "export"))
    cluster_options(add("cluster", "a scheduler or worker for grade --dask", "cluster"))
    add("ros2", "the ros2 commands, where the real ones are not installed", None)
    add("ready", "install what a command needs, and run nothing", None)
    add("wheels", "fetch every package into a folder, for a lab without a network", None)
    return top


class Adder:
    """Adds a command to the list."""

    def __init__(self, words: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
        self._words = words

    def __call__(self, name: str, about: str, function: str | None) -> argparse.ArgumentParser:
        """A command called `name` that runs `function` of the module `commands`."""
        word = self._words.add_parser(
            name, help=about, description=about[0].upper() + about[1:], allow_abbrev=False
        )
        if function:
            word.set_defaults(command=command(function))
        return word


def lab_options(word: argparse.ArgumentParser) -> None:
    """The lab's name."""
    word.add_argument("lab", metavar="LAB", help="for example: topics")


def package_options(word: argparse.ArgumentParser) -> None:
    """The lab, and where its package lies."""
    lab_options(word)
    word.add_argument(
        "path", metavar="PATH", type=Path, nargs="?",
        help="your package, or a folder that holds it (default: your workspace, ~/roslings_ws)",
    )  # fmt: skip


def check_options(word: argparse.ArgumentParser) -> None:
    """What `check` takes."""
    package_options(word)
    word.add_argument(
        "--solution", action="store_true", help="check the course's own solution instead"
    )
    verdict_options(word)
    hidden_option(word)
    word.add_argument(
        "--evidence", metavar="DIR", type=Path,
        help="save all that was seen in the new folder DIR, to judge it again (regrade)",
    )  # fmt: skip
    trust_option(word)
    soak_option(word, "0; as grade does where a platform's file is written")
    word.add_argument(
        "--clock", choices=("auto", "sim", "wall"), default="auto",
        help="simulated time where it can be believed (auto), always (sim), or never (wall)",
    )  # fmt: skip
    word.add_argument(
        "--seed", metavar="N", type=int, help="repeat the random choices of a verdict"
    )
    word.add_argument(
        "--port", metavar="DEVICE", type=Path,
        help="use the real board on this serial port, for example /dev/ttyACM0",
    )  # fmt: skip
    word.add_argument(
        "--timings", action="store_true", help="show where the seconds of the check went"
    )
    word.add_argument(
        "--hint", metavar="STEP", type=int, choices=(1, 2, 3), nargs="?", const=1,
        help="a hint for what your last check found: 1 where, 2 which idea, 3 other code",
    )  # fmt: skip


def regrade_options(word: argparse.ArgumentParser) -> None:
    """What `regrade` takes."""
    lab_options(word)
    word.add_argument(
        "evidence", metavar="EVIDENCE", type=Path,
        help="the folder that check --evidence made, or the --out of ./roslings grade",
    )  # fmt: skip
    hidden_option(word)
    verdict_options(word)
    word.set_defaults(hint=None)


def trust_option(word: argparse.ArgumentParser) -> None:
    """Whether strangers' code runs where no wall holds it."""
    word.add_argument(
        "--trust", action="store_true", help="run submissions although there is no sandbox"
    )


def hidden_option(word: argparse.ArgumentParser) -> None:
    """Checks beyond the lab's own."""
    word.add_argument(
        "--hidden", metavar="FILE", type=Path, help="a grader with checks that students do not have"
    )


def soak_option(word: argparse.ArgumentParser, default: str) -> None:
    """How long nodes are left running."""
    word.add_argument(
        "--soak", metavar="SECONDS", type=seconds_of_soak,
        help=f"let the nodes run on for so long, to see that they stay (default: {default})",
    )  # fmt: skip


def seconds_of_soak(text: str) -> float:
    """A number from 0 to 600. Raises ArgumentTypeError."""
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0 <= seconds <= 600:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of seconds from 0 to 600")
    return seconds


def grade_options(word: argparse.ArgumentParser) -> None:
    """What `grade` takes."""
    lab_options(word)
    word.add_argument(
        "submissions", metavar="SUBMISSIONS", type=Path,
        help="Moodle's or Canvas's zip of the class; or a folder of folders, .zip and .tar.gz"
        " files, or a CSV file with their paths",
    )  # fmt: skip
    word.add_argument(
        "--out", metavar="DIR", type=Path, required=True,
        help="where the gradebook goes; the same command goes on where it was ended",
    )  # fmt: skip
    word.add_argument(
        "--jobs", metavar="N", type=whole_number, help="how many at once (default: measured)"
    )
    hidden_option(word)
    trust_option(word)
    word.add_argument("--clock", choices=("auto", "sim", "wall"), default="auto")
    word.add_argument(
        "--limit", metavar="SECONDS", type=whole_number, default=900,
        help="the most that one grading may take (default: 900)",
    )  # fmt: skip
    soak_option(word, "half a minute, or what the card says")
    word.add_argument(
        "--dask", metavar="ADDRESS", help="grade on a Dask cluster, for example tcp://10.0.0.5:8786"
    )
    word.add_argument(
        "--evidence", action="store_true", help="with --dask: bring the evidence back as well"
    )
    roster_options(word)


def roster_options(word: argparse.ArgumentParser) -> None:
    """Who is in the class, and what being late costs."""
    word.add_argument(
        "--roster", metavar="FILE", type=Path,
        help="the class list, a CSV file with name, id, email; tells who is missing",
    )  # fmt: skip
    word.add_argument(
        "--deadline", metavar="TIME", help="for example 2026-11-30T23:59; late days are counted"
    )
    word.add_argument(
        "--late-points", metavar="P", type=float, default=0.0, help="what each day late costs"
    )
    word.add_argument(
        "--late-free", metavar="N", type=int, default=0, help="late days that cost nothing"
    )
    word.add_argument(
        "--canvas-assignment", metavar="NAME", default="",
        help='the head of the column in canvas.csv, for example "Lab 3 (48151)"',
    )  # fmt: skip


def override_options(word: argparse.ArgumentParser) -> None:
    """What `override` takes."""
    word.add_argument("folder", metavar="DIR", type=Path, help="the --out of ./roslings grade")
    word.add_argument("submission", metavar="SUBMISSION", help="its name, or the student's")
    word.add_argument("score", metavar="SCORE", type=float, help="0 to 100")
    word.add_argument("--reason", required=True, help="kept beside the score")
    word.add_argument("--by", metavar="NAME", help="who says so (default: your user name)")


def new_lab_options(word: argparse.ArgumentParser) -> None:
    """What `new-lab` takes."""
    word.add_argument("lab", metavar="NAME", help="for example: line-follower")
    word.add_argument("--package", metavar="NAME", help="default: the lab's name, with _ for -")
    word.add_argument("--day", metavar="DAY", help="a folder of days/ (default: the last)")


def prove_options(word: argparse.ArgumentParser) -> None:
    """What `prove` takes."""
    word.add_argument("labs", metavar="LAB", nargs="+", help="for example: topics")
    word.add_argument("--all", action="store_true", help="list what holds, too")
    word.add_argument(
        "--packages", action="store_true",
        help="only: solution, starter and mutants get the verdicts that they must get",
    )  # fmt: skip
    word.add_argument(
        "--contract", action="store_true",
        help="only: each word of the card, and each sentence of the task, is judged",
    )  # fmt: skip
    word.add_argument(
        "--generated", action="store_true",
        help="make 100 wrong packages of the solution; 95 of 100 must be caught",
    )  # fmt: skip
    word.add_argument(
        "--keep", metavar="DIR", type=Path,
        help="with --generated: where results stay, so that an interrupted run goes on",
    )  # fmt: skip
    word.add_argument(
        "--so-far", action="store_true",
        help="with --generated: grade nothing, and tell what is known",
    )  # fmt: skip
    word.add_argument(
        "--keep-kills", metavar="DIR", type=Path,
        help="with --generated: put evidence of a few that were caught into DIR/LAB",
    )  # fmt: skip
    word.add_argument(
        "--rewritten", action="store_true",
        help="write the solution in other ways; each must get 100",
    )  # fmt: skip
    word.add_argument(
        "--jobs", metavar="N", type=whole_number, help="how many at once (default: measured)"
    )


def release_options(word: argparse.ArgumentParser) -> None:
    """What `release` takes."""
    word.add_argument("--to", metavar="DIR", type=Path, required=True, help="a new folder")


def export_options(word: argparse.ArgumentParser) -> None:
    """What `export` takes."""
    word.add_argument("system", metavar="SYSTEM", help="gradescope, prairielearn, ... (any: help)")
    lab_options(word)
    word.add_argument("--to", metavar="DIR", type=Path, required=True, help="a new folder")
    hidden_option(word)


def cluster_options(word: argparse.ArgumentParser) -> None:
    """What `cluster` takes."""
    word.add_argument("part", choices=("scheduler", "worker"))
    word.add_argument("rest", nargs=argparse.REMAINDER, metavar="...", help="options for dask")


def whole_number(text: str) -> int:
    """A number from 1 on."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("give a number from 1 on")
    return number


def verdict_options(word: argparse.ArgumentParser) -> None:
    """Where a verdict goes, and how much of it is shown."""
    word.add_argument(
        "--json", metavar="FILE", type=Path, help="write the verdict to FILE (- here)"
    )
    word.add_argument(
        "--html", metavar="FILE", type=Path, help="write a page for a browser, with pictures"
    )
    for name, whose in SHAPES.items():
        word.add_argument(f"--{name}", metavar="FILE", type=Path, help=f"write it for {whose}")
    word.add_argument("--only", metavar="ID", help="show one check only, by its short name")
    word.add_argument(
        "--all", action="store_true", help="show every check whole; a screen folds what can wait"
    )


def watch_options(word: argparse.ArgumentParser) -> None:
    """What `watch` takes."""
    package_options(word)
    word.set_defaults(
        solution=False, json=None, html=None, evidence=None, only=None, seed=None, hint=None,
        clock="auto", port=None, hidden=None, trust=False, timings=False, all=False, soak=None,
    )  # fmt: skip


def pack_options(word: argparse.ArgumentParser) -> None:
    """What `pack` takes."""
    package_options(word)
    word.add_argument("--out", metavar="FILE", type=Path, help="the zip (default: LAB.zip here)")
    soak_option(word, "as where it is graded; 0 skips it")


def graph_options(word: argparse.ArgumentParser) -> None:
    """What `graph` takes."""
    word.add_argument(
        "--for", metavar="LAB", dest="lab", help="save the picture that LAB wants in your package"
    )
    word.add_argument(
        "path", metavar="PATH", type=Path, nargs="?", help="with --for: your package, as for check"
    )
    word.add_argument("--save", metavar="FILE.png", type=Path, help="save a picture of it")
    word.add_argument("--force", action="store_true", help="replace FILE.png if it is there")
    word.add_argument("--all", action="store_true", help="also /rosout and other parts of ROS")


def jupyter_options(word: argparse.ArgumentParser) -> None:
    """What `lab` takes."""
    word.add_argument(
        "day", metavar="DAY", nargs="?", help="for example: 3, or 03-topics (default: today's)"
    )
    word.add_argument("--no-browser", action="store_true", help="print the address, open nothing")
    word.add_argument("--port", metavar="N", type=int, help="default: 8888, or the next free one")
    word.add_argument(
        "--ip",
        metavar="ADDRESS",
        help="who may open it; 0.0.0.0 in a container (default: this computer)",
    )


def rover_options(word: argparse.ArgumentParser) -> None:
    """What `rover` takes."""
    word.add_argument(
        "--view", choices=("auto", "window", "terminal", "lines"), default="auto",
        help="where the map is shown (default: a window where there is a screen)",
    )  # fmt: skip
    word.add_argument("--save", metavar="FILE.png", type=Path, help="save the map at the end")
    word.add_argument("--seed", metavar="N", type=int, default=0, help="for the sensors' noise")


def board_options(word: argparse.ArgumentParser) -> None:
    """What `board` takes."""
    word.add_argument("--port", metavar="FILE", type=Path, help="default: /tmp/ttyROVER")
    word.add_argument(
        "--sketch",
        metavar="FILE.ino",
        type=Path,
        help="run this sketch, in an emulated Mega",
    )


def camera_options(word: argparse.ArgumentParser) -> None:
    """What `camera` takes."""
    word.add_argument("--device", metavar="PATH", type=Path, help="default: /tmp/rover_camera")
    word.add_argument(
        "--hue", type=int, default=5, metavar="0..179", help="the ball's colour, as OpenCV counts"
    )
    word.add_argument(
        "--noise", type=float, default=4.0, metavar="LEVELS", help="of each value, of 255"
    )


def site_options(word: argparse.ArgumentParser) -> None:
    """What `site` takes."""
    word.add_argument("--open", action="store_true", help="open it in the browser")
    word.add_argument("--fresh", action="store_true", help="build all of it anew")
    links = word.add_mutually_exclusive_group()
    links.add_argument("--links", action="store_true", help="list the links to other sites")
    links.add_argument(
        "--check-links", action="store_true", help="try the links to other sites (needs a network)"
    )
    word.add_argument(
        "--out", metavar="DIR", type=Path, help="where to build (default: build/site)"
    )


def test_options(word: argparse.ArgumentParser) -> None:
    """What `test` takes: the rest goes to pytest."""
    word.add_argument("rest", nargs=argparse.REMAINDER, metavar="...", help="options for pytest")
