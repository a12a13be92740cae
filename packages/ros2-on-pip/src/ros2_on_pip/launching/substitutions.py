"""The substitutions that launch files use, by the names of Jazzy."""

from __future__ import annotations

import importlib
import math
import os
import shlex
import shutil
import subprocess
import uuid
from collections.abc import Iterable
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

from ros2_on_pip.launching.substitution import (
    Parts,
    SomeSubstitutionsType,
    Substitution,
    SubstitutionFailure,
    described,
    is_substitution,
    parts_of,
    parts_or_none,
    performed,
    performed_or_none,
)
from ros2_on_pip.launching.typed import yaml_truth
from ros2_on_pip.launching.wrong_kind import Refused
from ros2_on_pip.problem import did_you_mean

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext

TRUE, FALSE = ("true", "1"), ("false", "0")


def truth(text: str, what: str) -> bool:
    """`true`, `1`, `false` or `0`, in capitals or not. Raises SubstitutionFailure."""
    word = text.strip().lower()
    if word not in (*TRUE, *FALSE):
        raise SubstitutionFailure(f"{what} is true or false, and not '{text}'")
    return word in TRUE


class LaunchConfiguration(Substitution):
    """The value of a launch argument, or of what SetLaunchConfiguration has set."""

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: Any | None = None) -> None:
        self.variable_name = parts_of(variable_name, "the name of a LaunchConfiguration")
        self.default = None if default is None else parts_of(_as_texts(default), "default")

    def perform(self, context: LaunchContext) -> Any:
        """The value: a text, unless a function has set another one. Raises SubstitutionFailure."""
        name = performed(context, self.variable_name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self.default is not None:
            return performed(context, self.default)
        near = did_you_mean(name, context.launch_configurations)
        raise SubstitutionFailure(
            f"launch configuration '{name}' does not exist: no argument, and nothing that was set"
            f" before this line, has this name.{near}"
        )

    def describe(self) -> str:
        """By its name."""
        return f"LaunchConfig({described(self.variable_name)})"


def _as_texts(default: Any) -> list[str | Substitution]:
    """What a default is put together of: a number, and any other value, becomes a text."""
    is_one = isinstance(default, str) or not isinstance(default, Iterable)
    items = [default] if is_one else default
    return [one if isinstance(one, str | Substitution) else str(one) for one in items]


class EnvironmentVariable(Substitution):
    """A variable of the environment."""

    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None
    ) -> None:
        self.name = parts_of(name, "the name of an EnvironmentVariable")
        self.default_value = parts_or_none(default_value, "default_value of EnvironmentVariable")

    def perform(self, context: LaunchContext) -> str:
        """The value. Raises SubstitutionFailure, also where a default that is not needed fails."""
        default = performed_or_none(context, self.default_value)
        name = performed(context, self.name)
        value = context.environment.get(name, default)
        if value is None:
            raise SubstitutionFailure(
                f"the environment variable {name} is not set: export {name}=..."
            )
        return value

    def describe(self) -> str:
        """By its name."""
        return f"EnvVar({described(self.name)})"


class _Listed(Substitution):
    """Base of those that are made of several texts."""

    def __init__(self, texts: Iterable[SomeSubstitutionsType]) -> None:
        what = f"each part of {type(self).__name__}"
        self.texts: list[Parts] = [parts_of(one, what) for one in texts]

    def performed_texts(self, context: LaunchContext) -> list[str]:
        """The texts. Raises SubstitutionFailure."""
        return [performed(context, one) for one in self.texts]

    def describe(self) -> str:
        """With its texts."""
        return f"{type(self).__name__}({', '.join(described(one) for one in self.texts)})"


class PathJoinSubstitution(_Listed):
    """Parts of a path, with slashes between them."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType]) -> None:
        """`substitutions` is a list, also of one part. Raises TypeError."""
        if isinstance(substitutions, str | PurePath | Substitution):
            name = type(self).__name__
            raise TypeError(f"{name} takes a list of parts, {name}([...]), not {substitutions!r}")
        super().__init__(substitutions)

    def perform(self, context: LaunchContext) -> str:
        """The path; a part that is empty at the end leaves a slash. Raises SubstitutionFailure."""
        if not self.texts:
            raise SubstitutionFailure(f"{type(self).__name__} has no part")
        return os.path.join(*self.performed_texts(context))  # noqa: PTH118  # a Path drops slashes

    def __truediv__(self, more: SomeSubstitutionsType) -> PathJoinSubstitution:
        """One more part behind it."""
        return PathJoinSubstitution([*self.texts, parts_of(more, "a part of a path")])


class PathSubstitution(PathJoinSubstitution):
    """A path that `/` makes longer."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__(parts_of(path, "path of PathSubstitution"))


class PythonExpression(_Listed):
    """What Python makes of an expression."""

    def __init__(
        self,
        expression: SomeSubstitutionsType,
        python_modules: SomeSubstitutionsType = ("math",),
    ) -> None:
        """Each of `python_modules` is a module; a text is one. Raises WrongKind."""
        super().__init__([expression])
        self.python_modules = parts_of(python_modules, "python_modules of PythonExpression")

    def perform(self, context: LaunchContext) -> str:
        """The value as a text. Raises SubstitutionFailure."""
        (text,) = self.performed_texts(context)
        try:
            return str(eval(text, {}, self._known(context)))
        except Exception as fault:
            raise SubstitutionFailure(
                f"Python cannot make a value of `{text}`: {type(fault).__name__}: {fault}."
                " A text in it needs quotes of its own: \"'\", LaunchConfiguration('x'), \"'\""
            ) from None

    def _known(self, context: LaunchContext) -> dict[str, Any]:
        """Each module by its name, and what is in math without it, too."""
        names = [performed(context, [one]) for one in self.python_modules]
        known: dict[str, Any] = {name: importlib.import_module(name) for name in names}
        return known | (vars(known["math"]) if "math" in known else {})


ON_STDERR = ("fail", "ignore", "warn", "capture")


class Command(_Listed):
    """What a command prints."""

    def __init__(
        self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail"
    ) -> None:
        super().__init__([command, on_stderr])

    def perform(self, context: LaunchContext) -> str:
        """The output. Raises SubstitutionFailure."""
        text, on_stderr = self.performed_texts(context)
        if on_stderr not in ON_STDERR:
            known = ", ".join(ON_STDERR)
            raise SubstitutionFailure(
                f"on_stderr is one of {known}, and not '{on_stderr}'."
                f"{did_you_mean(on_stderr, ON_STDERR)}"
            )
        try:
            done = subprocess.run(
                shlex.split(text),
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT if on_stderr == "capture" else subprocess.PIPE,
                text=True,
                check=False,
                stdin=subprocess.DEVNULL,
                env=dict(context.environment),
            )
        except (OSError, ValueError) as fault:
            raise SubstitutionFailure(f"the command `{text}` cannot be run: {fault}") from None
        if done.returncode or (done.stderr and on_stderr == "fail"):
            said = (done.stderr or done.stdout).strip() or "no word about the reason"
            raise SubstitutionFailure(
                f"the command `{text}` ended with exit code {done.returncode}: {said}"
            )
        if done.stderr and on_stderr == "warn":
            context.say(f"[WARNING] [launch]: `{text}` says: {done.stderr.strip()}")
        return done.stdout


class FindExecutable(Substitution):
    """The path of a command."""

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        self.name = parts_of(name, "name of FindExecutable")

    def perform(self, context: LaunchContext) -> str:
        """The path. Raises SubstitutionFailure."""
        name = performed(context, self.name)
        found = shutil.which(name, path=context.environment.get("PATH"))
        if found is None:
            raise SubstitutionFailure(f"executable '{name}' not found on the PATH")
        return found

    def describe(self) -> str:
        """By its name."""
        return f"FindExec({described(self.name)})"


class _Folder(Substitution):
    """Base of those that `/` makes longer."""

    def __truediv__(self, more: SomeSubstitutionsType) -> PathJoinSubstitution:
        """One more part behind it."""
        return PathJoinSubstitution([self, parts_of(more, "a part of a path")])


class FindPackagePrefix(_Folder):
    """The folder that a package is installed in."""

    def __init__(self, package: SomeSubstitutionsType) -> None:
        self.package = parts_of(package, f"package of {type(self).__name__}")

    def perform(self, context: LaunchContext) -> str:
        """The folder. Raises PackageNotFound."""
        return self.find(performed(context, self.package))

    def find(self, package_name: str) -> str:
        """The folder of any package, at once: guides use it so. Raises PackageNotFound."""
        from ros2_on_pip.packages import prefix_of

        return str(prefix_of(package_name))

    def describe(self) -> str:
        """By the package."""
        return f"{type(self).__name__}(pkg={described(self.package)})"


class FindPackageShare(FindPackagePrefix):
    """The share folder of a package."""

    def find(self, package_name: str) -> str:
        """The folder of any package, at once. Raises PackageNotFound."""
        from ros2_on_pip.packages import share_of

        return str(share_of(package_name))


class ExecutableInPackage(_Listed):
    """The path of an executable of a package."""

    def __init__(self, executable: SomeSubstitutionsType, package: SomeSubstitutionsType) -> None:
        super().__init__([executable, package])

    def perform(self, context: LaunchContext) -> str:
        """The path. Raises PackageNotFound, NoSuchExecutable."""
        from ros2_on_pip.packages import executable as find

        name, package = self.performed_texts(context)
        return str(find(package, name))


class ThisLaunchFile(Substitution):
    """The path of the launch file that this stands in."""

    def perform(self, context: LaunchContext) -> str:
        """The path. Raises SubstitutionFailure."""
        if context.file is None:
            raise SubstitutionFailure("no launch file is being read any more when this is done")
        return str(context.file)


class ThisLaunchFileDir(ThisLaunchFile):
    """The folder of the launch file that this stands in."""

    def perform(self, context: LaunchContext) -> str:
        """The folder. Raises SubstitutionFailure."""
        return str(Path(super().perform(context)).parent)


class LaunchLogDir(Substitution):
    """The folder of the log files of this launch."""

    def perform(self, context: LaunchContext) -> str:
        """The folder."""
        return str(context.log_folder)


class FileContent(_Listed):
    """The text of a file."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__([path])

    def perform(self, context: LaunchContext) -> str:
        """The text. Raises SubstitutionFailure."""
        (path,) = self.performed_texts(context)
        try:
            return Path(path).read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as fault:
            raise SubstitutionFailure(f"{path} cannot be read: {fault}") from None


class AnonName(_Listed):
    """A name that no other node has; the same name gives the same."""

    def __init__(self, name: SomeSubstitutionsType) -> None:
        super().__init__([name])

    def perform(self, context: LaunchContext) -> str:
        """The name with a tail that is new in each launch."""
        (name,) = self.performed_texts(context)
        tail = f"{os.getpid()}_{uuid.uuid4().hex[:12]}"
        return str(context.launch_configurations.setdefault(f"anon{name}", f"{name}_{tail}"))


class LocalSubstitution(Substitution):
    """What an event brings along, such as `event.reason`."""

    def __init__(self, expression: str, description: str | None = None) -> None:
        if not isinstance(expression, str):
            raise TypeError(
                "expression of LocalSubstitution must be a text, such as 'event.reason', not"
                f" {expression!r}"
            )
        self.expression, self.description = expression, description

    def perform(self, context: LaunchContext) -> Any:
        """The value as it is; a text can only be made of texts. Raises SubstitutionFailure."""
        try:
            return eval(f"known.{self.expression}", {"known": context.locals})
        except AttributeError:
            raise SubstitutionFailure(
                f"there is no '{self.expression}' here: only what an event handler starts"
                " knows its event"
            ) from None
        except Exception as fault:
            raise SubstitutionFailure(f"'{self.expression}': {fault}") from None

    def describe(self) -> str:
        """With its expression, or what was said about it."""
        return f"LocalVar('{self.description or self.expression}')"


class EqualsSubstitution(_Listed):
    """Whether two values are equal, `true` or `false`."""

    def __init__(self, left: Any, right: Any) -> None:
        """Each side may be any value: None is the empty text, and True is `true`."""
        super().__init__([_as_text(left), _as_text(right)])

    def perform(self, context: LaunchContext) -> str:
        """`true` or `false`. Raises SubstitutionFailure."""
        return _word(_same(*self.performed_texts(context)))


class NotEqualsSubstitution(EqualsSubstitution):
    """Whether two texts differ."""

    def perform(self, context: LaunchContext) -> str:
        """`true` or `false`. Raises SubstitutionFailure."""
        return _word(super().perform(context) == "false")


class NotSubstitution(_Listed):
    """The contrary."""

    def __init__(self, value: SomeSubstitutionsType) -> None:
        super().__init__([value])

    def perform(self, context: LaunchContext) -> str:
        """`true` or `false`. Raises SubstitutionFailure."""
        (value,) = self.performed_texts(context)
        return _word(not yaml_truth(value, "what stands after not"))


class AndSubstitution(_Listed):
    """Both are true."""

    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None:
        super().__init__([left, right])

    def perform(self, context: LaunchContext) -> str:
        """`true` or `false`. Raises SubstitutionFailure."""
        texts = self.performed_texts(context)
        return _word(all([yaml_truth(text, "each side of and") for text in texts]))


class OrSubstitution(AndSubstitution):
    """One of both is true, or both are."""

    def perform(self, context: LaunchContext) -> str:
        """`true` or `false`. Raises SubstitutionFailure."""
        texts = self.performed_texts(context)
        return _word(any([yaml_truth(text, "each side of or") for text in texts]))


class IfElseSubstitution(_Listed):
    """One of two texts."""

    def __init__(
        self,
        condition: SomeSubstitutionsType,
        if_value: SomeSubstitutionsType = "",
        else_value: SomeSubstitutionsType = "",
    ) -> None:
        if if_value == else_value == "":
            raise Refused("IfElseSubstitution needs a text: if_value='...', or else_value='...'")
        super().__init__([condition, if_value, else_value])

    def perform(self, context: LaunchContext) -> str:
        """The first text where the condition is true, else the second."""
        condition, yes, no = self.texts
        chosen = yaml_truth(performed(context, condition), "the condition of IfElseSubstitution")
        return performed(context, yes if chosen else no)


def _word(value: bool) -> str:
    return "true" if value else "false"


def _as_text(value: Any) -> Any:
    if is_substitution(value):
        return value
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _same(left: str, right: str) -> bool:
    """Two truths and two numbers by what they mean, anything else by its letters."""
    truths = [text.lower() in TRUE for text in (left, right) if text.lower() in (*TRUE, *FALSE)]
    if len(truths) == 2:
        return truths[0] == truths[1]
    try:
        return math.isclose(float(left), float(right))
    except ValueError:
        return left == right
