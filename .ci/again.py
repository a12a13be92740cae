"""What failed in the stage before, run again: alone, and twice.

    python .ci/again.py COSTS BEFORE STAGES

COSTS has a line of JSON for each test (`tests/costs.py`), BEFORE of them from earlier stages.
Where all pass both times, the stage's status in STAGES (its last line) becomes 0, and each test is
named as unsteady, with the line for `tests/unsteady.yaml`. Ends with 0 there, else with 1.
"""

from __future__ import annotations

import json
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path

MOST = 6
"""So many tests are not unsteady together: something is wrong with the change."""

TIMES = 2
REASON = "failed beside others, passed twice alone"


def failed(costs: Path, before: int) -> list[str]:
    """The tests of the stage that did not pass."""
    lines = costs.read_text("utf-8").splitlines()[before:] if costs.exists() else []
    tests = map(json.loads, lines)
    return [str(each["test"]) for each in tests if each["outcome"] == "failed"]


def passes_alone(tests: list[str]) -> bool:
    """Each time. A cell of a lesson is a test where nbval is asked for it."""
    command = ["./roslings", "test", "-m", "", "-n", "0", "--nbval-lax", *tests]
    return all(subprocess.run(command, check=False).returncode == 0 for _ in range(TIMES))


def line_for(test: str) -> str:
    """The entry, to be pasted; JSON's strings are YAML's as well."""
    today = datetime.now(timezone.utc).date()
    named = json.dumps(test, ensure_ascii=False)
    return f'- {{test: {named}, date: {today}, reason: "{REASON}"}}'


def forgive(stages: Path) -> None:
    """The stage that was run last has passed."""
    *earlier, last = stages.read_text("utf-8").splitlines()
    wall, cpu, _, name = last.split(maxsplit=3)
    stages.write_text("\n".join([*earlier, f"{wall} {cpu} 0 {name}", ""]), "utf-8")


def main(costs: Path, before: int, stages: Path) -> int:
    """Whether all that failed is only unsteady."""
    tests = failed(costs, before)
    if not 0 < len(tests) <= MOST or not passes_alone(tests):
        return 1
    for test in tests:
        print(f"UNSTEADY, failed beside others and passed twice alone: {test}")
    print("For tests/unsteady.yaml, with the reason in place of its last words:")
    for test in tests:
        print(line_for(test))
    unsteady = stages.with_name("unsteady")
    with unsteady.open("a", encoding="utf-8") as file:
        file.writelines(f"{test}\n" for test in tests)
    forgive(stages)
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])))
