"""Parameter files: which of their values are for which node."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ros2_on_pip.parameters import flat
from ros2_on_pip.problem import CommandProblem

INSIDE = "ros__parameters"


class BadParameterFile(CommandProblem):
    """The file cannot be read as parameters."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(
            f"{path}: {reason}.\nThe form is:\n/my_node:\n  {INSIDE}:\n    my_parameter: 1.5"
        )


class NothingForNode(CommandProblem):
    """The file has values, and none of them is for this node."""

    def __init__(self, path: Path, node: str, there: list[str]) -> None:
        super().__init__(
            f"Param file does not contain parameters for {node}: {path} has only:"
            f" {', '.join(there) or 'nothing'}"
        )


def values_for(path: Path, node: str, wildcards: bool = True) -> dict[str, Any]:
    """The values in the file that are for `node`: entries for many nodes, then those for it alone.

    Without `wildcards` entries such as `/**`, which are for many nodes, are left out.
    Raises BadParameterFile, NothingForNode.
    """
    tree = _read(path)
    values: dict[str, Any] = {}
    chosen = [n for n in tree if _is_for(str(n), node) and (wildcards or "*" not in str(n))]
    for name in sorted(chosen, key=lambda name: "*" not in str(name)):
        values |= flat(_parameters(path, name, tree[name]))
    if not values:
        raise NothingForNode(path, node, [str(name) for name in tree])
    return values


def _read(path: Path) -> Mapping[Any, Any]:
    import yaml

    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as fault:
        raise BadParameterFile(path, fault.strerror or str(fault)) from None
    except yaml.YAMLError as fault:
        raise BadParameterFile(path, f"it is no valid YAML: {fault}") from None
    if not isinstance(tree, Mapping):
        raise BadParameterFile(path, "it names no node")
    return tree


def _parameters(path: Path, name: str, entry: Any) -> Mapping[str, Any]:
    if not isinstance(entry, Mapping) or not isinstance(entry.get(INSIDE), Mapping):
        raise BadParameterFile(path, f"the entry '{name}' has no part '{INSIDE}'")
    parameters: Mapping[str, Any] = entry[INSIDE]
    return parameters


def _is_for(name: str, node: str) -> bool:
    """`/**` is for every node, `*` stands for one part of a name, a bare name is the node's own."""
    if "/" not in name and "*" not in name:
        return name == node.rpartition("/")[2]
    pattern = re.escape(name if name.startswith("/") else f"/{name}")
    pattern = pattern.replace(r"\*\*", ".*").replace(r"\*", "[^/]*")
    return re.fullmatch(pattern, node) is not None
