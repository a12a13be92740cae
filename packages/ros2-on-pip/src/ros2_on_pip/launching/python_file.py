"""Launch files in Python: the student's code, carried out by the launching process alone."""

from __future__ import annotations

import inspect
import linecache
import re
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType, TracebackType
from typing import Any

from ros2_on_pip.launching import elsewhere, jazzy
from ros2_on_pip.launching.description import LaunchDescription
from ros2_on_pip.launching.places import OURS, BadLaunchFile, LaunchFileLine, NotReadHere
from ros2_on_pip.launching.wrong_kind import Refused
from ros2_on_pip.problem import CommandProblem, did_you_mean

FUNCTION = "generate_launch_description"
_running: list[LaunchFileLine] = []
_traced: list[bool] = []
MISSING = re.compile(r"(\w+)\.__init__\(\) missing \d+ required .*arguments?: (.*)")
NO_ATTRIBUTE = re.compile(r"module '([\w.]+)' has no attribute '(\w+)'")
NOT_IMPORTED = re.compile(r"cannot import name '(\w+)' from '([\w.]+)'")


def described_by(file: Path) -> LaunchDescription:
    """What the file's function returns. Raises BadLaunchFile, NotReadHere."""
    module = _carried_out(file)
    make = getattr(module, FUNCTION, None)
    if not callable(make):
        raise BadLaunchFile(LaunchFileLine(file, 1), _no_function(module))
    place = LaunchFileLine(file, inspect.unwrap(make).__code__.co_firstlineno)
    with students_code(place):
        made = make()
    if isinstance(made, LaunchDescription):
        return made
    raise BadLaunchFile(place, _no_description(made))


def _no_function(module: ModuleType) -> str:
    functions = [name for name, value in vars(module).items() if inspect.isfunction(value)]
    return (
        f"the file has no function {FUNCTION}().{did_you_mean(FUNCTION, functions)}"
        f" Write: def {FUNCTION}(): return LaunchDescription([...])"
    )


def _no_description(made: Any) -> str:
    what = "nothing" if made is None else f"{made!r}"
    return f"{FUNCTION}() returns {what}. End it with: return LaunchDescription([...])"


def _carried_out(file: Path) -> ModuleType:
    """The file as a module; nothing is written beside it. Raises BadLaunchFile."""
    module = ModuleType(f"launch_file_{file.stem.replace('.', '_')}")
    module.__file__ = str(file)
    sys.modules[module.__name__] = module  # dataclasses look for the module that they are in
    with students_code(LaunchFileLine(file, 1)):
        exec(compile(file.read_bytes(), str(file), "exec", dont_inherit=True), vars(module))
    return module


@contextmanager
def students_code(place: LaunchFileLine) -> Iterator[None]:
    """What goes wrong inside is told with its line, not as a traceback. Raises BadLaunchFile."""
    _running.append(place)
    try:
        yield
    except BadLaunchFile:
        raise
    except CommandProblem as problem:
        raise BadLaunchFile(place, str(problem)) from None
    except SyntaxError as fault:
        _trace()
        raise BadLaunchFile(_place_of_syntax(fault, place), _syntax(fault)) from None
    except SystemExit:
        raise BadLaunchFile(place, "the launch file ends Python itself. Take exit() out") from None
    except ModuleNotFoundError as fault:
        raise _no_module(_where(fault.__traceback__, place), fault) from None
    except Exception as fault:
        _trace()
        raise _fault(_where(fault.__traceback__, place), fault) from None
    finally:
        _running.pop()


def show_traces() -> None:
    """From now on a fault is shown with its traceback, too."""
    _traced.append(True)


def _trace() -> None:
    if _traced:
        traceback.print_exc()


def in_students_code() -> bool:
    """Whether it is being carried out now."""
    return bool(_running)


def _place_of_syntax(fault: SyntaxError, place: LaunchFileLine) -> LaunchFileLine:
    file = Path(fault.filename) if fault.filename else place.file
    return LaunchFileLine(file, fault.lineno or 1)


def _syntax(fault: SyntaxError) -> str:
    line = (fault.text or "").rstrip("\n")
    mistake = fault.msg.removesuffix("?")
    return f"no valid Python: {mistake}. Look at this line, and at the one before it:\n{line}"


def _where(trace: TracebackType | None, place: LaunchFileLine) -> LaunchFileLine:
    """The last line of the launch file that was being carried out, or of a file beside it."""
    frames = [(Path(f.f_code.co_filename), line) for f, line in traceback.walk_tb(trace)]
    own = [LaunchFileLine(*one) for one in frames if one[0] == place.file]
    others = [LaunchFileLine(*one) for one in frames if not str(one[0]).startswith((OURS, "<"))]
    return (own or others or [place])[-1]


def _line_of(place: LaunchFileLine) -> str:
    line = linecache.getline(str(place.file), place.line).strip()
    return f"\n    {line}" if line else ""


def _fault(where: LaunchFileLine, fault: Exception) -> BadLaunchFile:
    """A mistake, or something of Jazzy's objects that ours do not have."""
    if isinstance(fault, AttributeError) and (missing := _missing_attribute(fault)):
        return NotReadHere(where, missing)
    return BadLaunchFile(where, _told(fault) + _line_of(where))


def _missing_attribute(fault: AttributeError) -> str:
    cls = fault.obj if isinstance(fault.obj, type) else type(fault.obj)
    is_ours = cls.__module__.startswith(__name__.rpartition(".")[0])
    return (
        f"{cls.__name__}.{fault.name}" if is_ours and jazzy.has_attribute(cls, fault.name) else ""
    )


def _told(fault: Exception) -> str:
    for kind, tell in WORDS:
        if isinstance(fault, kind) and (text := tell(fault)):
            return text
    return f"{type(fault).__name__}: {fault}. Mend this line, and launch again:"


def _name_error(fault: Any) -> str:
    name = fault.name or ""
    home = elsewhere.home_of(name)
    step = f" It needs the line: from {home} import {name}" if home else ""
    near = step or did_you_mean(name, elsewhere.known_names())
    return f"the name '{name}' is not known.{near or ' Look how it is spelt, and imported:'}"


def _import_error(fault: Any) -> str:
    found = NOT_IMPORTED.search(str(fault))
    if not found:
        return ""
    name, module = found.groups()
    home = elsewhere.home_of(name)
    step = f" Write: from {home} import {name}" if home else ""
    return f"'{module}' has no '{name}'.{step or did_you_mean(name, elsewhere.names_in(module))}"


def _attribute_error(fault: Any) -> str:
    """A misspelt name behind `launch.actions.`, or one of another module."""
    found = NO_ATTRIBUTE.fullmatch(str(fault))
    if not found or found[1] not in jazzy.MODULES:
        return ""
    module, name = found.groups()
    home = elsewhere.home_of(name)
    step = f" Write: {home}.{name}" if home else did_you_mean(name, elsewhere.names_in(module))
    return f"'{module}' has no '{name}'.{step}"


def _package_error(fault: Any) -> str:
    from ros2_on_pip.packages import PackageNotFound

    if type(fault).__name__ != "PackageNotFoundError":
        return ""
    found = re.search(r"package '([^']*)'", str(fault))
    return str(PackageNotFound(found[1])) if found else ""


def _type_error(fault: Any) -> str:
    """Python's own words, except for those that a beginner cannot read."""
    text = str(fault)
    if found := MISSING.match(text):
        names = found[2].replace("'", "").replace(" and ", ", ").replace(",,", ",")
        return f"{found[1]} needs more: {names}"
    if text.startswith("LaunchDescription.__init__() takes"):
        return "LaunchDescription takes one list. Put [ and ] around the actions:"
    return text if text.endswith(("?", ".", ":")) else f"{text}."


WORDS: tuple[tuple[type[Exception], Callable[[Any], str]], ...] = (
    (NameError, _name_error),
    (ImportError, _import_error),
    (AttributeError, _attribute_error),
    (KeyError, _package_error),
    (TypeError, _type_error),
    (Refused, str),
)
"""Kind of a fault to how it is told; the first that has words for it tells."""


def _no_module(place: LaunchFileLine, fault: ModuleNotFoundError) -> BadLaunchFile:
    name = fault.name or ""
    if name in elsewhere.MODULES or name in jazzy.MODULES:
        return NotReadHere(place, f"'{name}'", elsewhere.instead_of(name))
    near = did_you_mean(name, elsewhere.known_modules())
    step = near or " Is it a package of yours? Build it, and source install/setup.bash."
    return BadLaunchFile(place, f"there is no module '{name}'.{step}{_line_of(place)}")
