"""The published JSON Schema of a verdict, made from the model.

`python -m roslings.report.schema` writes it anew beside this file.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from roslings.report.whole_file import write_whole
from roslings.verdict import SCHEMA_VERSION, Verdict

SCHEMA_FILE = Path(__file__).with_name("verdict.schema.json")


def verdict_schema() -> dict[str, Any]:
    """The schema (JSON Schema 2020-12) of what `--json` writes."""
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "$id": f"urn:roslings:verdict:{SCHEMA_VERSION}",
        **Verdict.model_json_schema(by_alias=True, mode="serialization"),
    }


def schema_text() -> str:
    """The schema as the file holds it."""
    return json.dumps(verdict_schema(), indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    write_whole(SCHEMA_FILE, schema_text().encode("utf-8"))
