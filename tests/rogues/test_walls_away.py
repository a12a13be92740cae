"""A rogue counts where it reaches something once its wall is taken away.

The course that grades is a copy of its own: a few lines of it are edited, and nothing else.
"""

from __future__ import annotations

import pytest
from gallery import hang
from rogue import Attempt, rogues
from stage import SANDBOX

from roslings.course import Edit
from skips import needs

ARENA = "packages/roslings/src/roslings/arena"
NO_FILTER = Edit(
    file=f"{ARENA}/process.py",
    find="return filters if (self.sandbox or self.user) and all(filters) else ()",
    replace="return ()",
)
OLD_KEYS = Edit(
    file=f"{ARENA}/guardian.py", find="        hold_no_keys()\n", replace="        pass\n"
)
NO_COVERS = Edit(file=f"{ARENA}/sandbox.py", find=", *_settings_and_keys()", replace="")
ROOTS_OWN = Edit(
    file=f"{ARENA}/isolation.py",
    find="    return _with_leased_user() if best.sandbox else best\n",
    replace="    return best\n",
)

TAKEN_AWAY: dict[str, tuple[tuple[Edit, ...], str]] = {
    "refused_calls": ((NO_FILTER,), "the call unshare"),
    "keyrings": ((NO_FILTER, OLD_KEYS), "the key b'instructors-key'"),
    "root_outside": ((ROOTS_OWN,), "the number of the owner of /usr"),
    "writes_kernel_settings": ((NO_COVERS, ROOTS_OWN), "the setting /proc/sys"),
}
"""By rogue: the walls, and what it reaches without them."""


@pytest.mark.slow
@needs("root", "filter of system calls", "keys of the kernel", *SANDBOX)
@pytest.mark.parametrize("name", TAKEN_AWAY)
def test_without_its_wall_a_rogue_reaches_something(name: str) -> None:
    """As root: for others, some of these walls stand in front of nothing."""
    without, reaches = TAKEN_AWAY[name]
    attempt = Attempt(next(each for each in rogues() if each.name == name), "run")
    seen = hang([attempt], ordinary=False, jobs=1, without=without).seen[attempt.name]
    assert [line for line in seen.reached if line.startswith(f"GOT {reaches}")], seen
