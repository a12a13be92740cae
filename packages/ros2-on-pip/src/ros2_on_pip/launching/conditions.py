"""Conditions of actions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ros2_on_pip.launching.substitution import (
    SomeSubstitutionsType,
    described,
    parts_of,
    performed,
)
from ros2_on_pip.launching.substitutions import truth

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext


class Condition:
    """What decides whether an action is carried out."""

    def evaluate(self, context: LaunchContext) -> bool:
        """Whether it holds; this one always does."""
        return True

    def describe(self) -> str:
        """How `--print` shows it."""
        return type(self).__name__


class IfCondition(Condition):
    """The action is carried out where a text is true."""

    def __init__(self, predicate_expression: SomeSubstitutionsType) -> None:
        self.predicate = parts_of(predicate_expression, f"what {type(self).__name__} looks at")

    def evaluate(self, context: LaunchContext) -> bool:
        """Whether it holds. Raises SubstitutionFailure."""
        return truth(performed(context, self.predicate), "a condition")

    def describe(self) -> str:
        """With what it looks at."""
        return f"{type(self).__name__}({described(self.predicate)})"


class UnlessCondition(IfCondition):
    """The action is carried out where a text is false."""

    def evaluate(self, context: LaunchContext) -> bool:
        """Whether it holds. Raises SubstitutionFailure."""
        return not super().evaluate(context)


class LaunchConfigurationEquals(Condition):
    """The action is carried out where a launch configuration has this value."""

    def __init__(
        self, launch_configuration_name: str, expected_value: SomeSubstitutionsType | None
    ) -> None:
        self.name = launch_configuration_name
        self.expected = None if expected_value is None else parts_of(expected_value, "the value")

    def evaluate(self, context: LaunchContext) -> bool:
        """Whether it holds. Raises SubstitutionFailure."""
        value = context.launch_configurations.get(self.name)
        if self.expected is None:
            return value is None
        return bool(value == performed(context, self.expected))


class LaunchConfigurationNotEquals(LaunchConfigurationEquals):
    """The action is carried out where a launch configuration has another value."""

    def evaluate(self, context: LaunchContext) -> bool:
        """Whether it holds. Raises SubstitutionFailure."""
        return not super().evaluate(context)
