"""A verdict as JSON, and back; the format is `verdict.schema.json` beside this file."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

from pydantic import ValidationError

from ros2_on_pip.errors import RoslingsError
from roslings.report.whole_file import write_whole
from roslings.verdict import SCHEMA_VERSION, Verdict

_HALF_CHARACTER = re.compile("[\ud800-\udfff]")


class BadVerdictFile(RoslingsError):
    """A file that should hold a verdict does not; the message says what to do."""


def write_json(verdict: Verdict, path: Path) -> None:
    """Write `verdict` to `path` as UTF-8 JSON; the path `-` is standard output.

    The file appears whole or not at all. Raises CannotWriteFile.
    """
    content = _json_of(verdict).encode("utf-8")
    if str(path) == "-":
        _write_stdout(content)
    else:
        write_whole(path, content)


def _json_of(verdict: Verdict) -> str:
    # Not model_dump_json: it refuses half characters, and a node's log may hold such bytes.
    text = json.dumps(verdict.model_dump(by_alias=True), indent=2, ensure_ascii=False)
    return _HALF_CHARACTER.sub("\ufffd", text) + "\n"


def _write_stdout(content: bytes) -> None:
    sys.stdout.flush()
    sys.stdout.buffer.write(content)  # JSON is UTF-8, whatever the terminal's encoding is
    sys.stdout.buffer.flush()


def read_json(path: Path) -> Verdict:
    """The verdict that `write_json` wrote to `path`. Raises BadVerdictFile."""
    try:
        return Verdict.model_validate_json(path.read_bytes())
    except OSError as error:
        raise BadVerdictFile(
            f"Cannot read {path}: {error.strerror}. Look at the path: is it the right one?"
        ) from error
    except ValidationError as error:
        raise BadVerdictFile(_what_is_wrong(path, error)) from error


def _what_is_wrong(path: Path, error: ValidationError) -> str:
    first = error.errors(include_url=False, include_context=False)[0]
    where = ".".join(map(str, first["loc"])) or "the file"
    return (
        f"{path} is not a verdict of schema {SCHEMA_VERSION}: {where}: {first['msg']}. "
        "Make it again with: ./roslings check LAB --json FILE"
    )
