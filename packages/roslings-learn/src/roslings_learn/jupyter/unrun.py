"""A lesson before anybody has run it: the outputs that the course compares give its answers away.

A student is asked what a cell will print before it runs, so the student's copy holds no outputs.
"""

from __future__ import annotations

import json


def unrun(notebook: bytes) -> bytes:
    """The notebook with no outputs; what is no notebook, or holds none, is left as it is."""
    try:
        content = json.loads(notebook)
        ran = [cell for cell in content["cells"] if cell.get("outputs")]
    except (ValueError, KeyError, TypeError, AttributeError):
        return notebook
    if not ran:
        return notebook
    for cell in ran:
        cell.update(execution_count=None, outputs=[])
    end = notebook[len(notebook.rstrip()) :]
    return json.dumps(content, indent=1, ensure_ascii=False).encode() + end
