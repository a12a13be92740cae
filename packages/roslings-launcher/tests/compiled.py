"""Which modules of an environment would be compiled again, each time that they are imported."""

from __future__ import annotations

from pathlib import Path

NOT_COMPILED = "pip"
"""It runs at a set-up only."""


def uncompiled(site: Path) -> list[str]:
    """The modules in `site`, but pip's, that have no bytecode of their present state.

    `site` ends with the folder of its Python: lib/python3.12/site-packages.
    """
    tag = "cpython-" + site.parent.name.removeprefix("python").replace(".", "")
    return [
        str(module.relative_to(site))
        for module in sorted(site.rglob("*.py"))
        if module.relative_to(site).parts[0] != NOT_COMPILED and not _has_bytecode(module, tag)
    ]


def _has_bytecode(module: Path, tag: str) -> bool:
    """As Python itself compares them: the time and the size of the source stand in the file."""
    bytecode = module.parent / "__pycache__" / f"{module.stem}.{tag}.pyc"
    if not bytecode.is_file():
        return False
    was, size = (int.from_bytes(bytecode.read_bytes()[at : at + 4], "little") for at in (8, 12))
    now = module.stat()
    return (was, size) == (int(now.st_mtime) & 0xFFFFFFFF, now.st_size & 0xFFFFFFFF)
