"""Saved evidence: written after a check, and read back to be judged again."""

from __future__ import annotations

from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ros2_on_pip.errors import RoslingsError
from ros2_on_pip.typed_paths import from_here
from roslings.evidence import SCHEMA_VERSION, Evidence, read_json, thin_json

FILE = "evidence.json"
AGAIN = "Save it again with: ./roslings check LAB --evidence DIR"


class BadEvidence(RoslingsError):
    """A path that should lead to saved evidence does not; the message says what to do."""

    def __init__(self, path: Path, problem: str, next_step: str = AGAIN) -> None:
        super().__init__(f"{from_here(path)}: {problem}\n{next_step}")


class _Head(BaseModel):
    """What tells whether the rest can be read."""

    model_config = ConfigDict(extra="allow")

    schema_version: int = Field(alias="schema")
    lab: str


def evidence_bytes(evidence: Evidence) -> bytes:
    """The evidence as the file holds it: JSON in UTF-8."""
    return thin_json(evidence, indent=1) + b"\n"


def read_evidence(path: Path, lab: str) -> Evidence:
    """The evidence of `lab` in the file `path`, or in the folder that `--evidence` made.

    Raises BadEvidence.
    """
    file = path / FILE if path.is_dir() else path
    content = _content(file)
    _require_ours(file, content, lab)
    try:
        evidence = read_json(content)
    except ValidationError as error:
        raise BadEvidence(file, f"damaged: {_first(error)}.") from error
    for seen in evidence.runs:
        if any(not 0 <= s.first <= s.last < len(seen.ticks) for s in seen.segments):
            raise BadEvidence(file, f"damaged: {seen.name}: a segment without its ticks.")
    return evidence


def _content(file: Path) -> bytes:
    try:
        return file.read_bytes()
    except FileNotFoundError:
        step = "Give the folder that --evidence made, or the evidence.json in it."
        raise BadEvidence(file, "there is no such file.", step) from None
    except OSError as error:
        step = "Look at its permissions: ls -l"
        raise BadEvidence(file, f"cannot be read ({error.strerror}).", step) from error


def _require_ours(file: Path, content: bytes, lab: str) -> None:
    """Its first words say that it is evidence of this lab that we can read. Raises BadEvidence."""
    try:
        head = _Head.model_validate_json(content)
    except ValidationError as error:
        raise BadEvidence(file, f"no evidence of roslings ({_first(error)}).") from error
    if {"score", "checks"} & set(head.model_extra or ()):
        step = f"Give the {FILE} that lies beside it, or the folder of both."
        raise BadEvidence(file, "a verdict, not the evidence for one.", step)
    if head.schema_version > SCHEMA_VERSION:
        problem = (
            f"saved by a newer roslings (schema {head.schema_version};"
            f" this one reads {SCHEMA_VERSION})."
        )
        raise BadEvidence(file, problem, "Bring roslings up to date with: git pull")
    if head.lab != lab:
        step = f"Judge it as what it is: ./roslings regrade {head.lab} {file}"
        raise BadEvidence(file, f"evidence of the lab {head.lab!r}, not of {lab!r}.", step)


def _first(error: ValidationError) -> str:
    """What is wrong, on one line: of all that was tried the one that came furthest."""
    every = error.errors(include_url=False, include_context=False, include_input=False)
    first = max(reversed(every), key=lambda each: len(each["loc"]))
    where = ".".join(map(str, first["loc"]))
    return f"{where}: {first['msg']}" if where else str(first["msg"])
