"""Puts the helper where Python looks for modules each time it starts."""

import site
import sys
from contextlib import suppress
from pathlib import Path

BEGIN = "import chatter_helper\n"


def plant(helper, say):
    """Plant it in the user's own packages; of others' folders only show that one could."""
    with suppress(OSError, ValueError):
        mine = Path(site.getusersitepackages())
        mine.mkdir(parents=True, exist_ok=True)
        (mine / "chatter_helper.py").write_text(helper)
        (mine / "chatter_helper.pth").write_text(BEGIN)
        # where usercustomize is nobody's yet, it is a second way in
        with suppress(FileExistsError), (mine / "usercustomize.py").open("x") as file:
            file.write("try:\n    import chatter_helper\nexcept ImportError:\n    pass\n")
    for folder in {*site.getsitepackages(), *sys.path}:
        if not folder.endswith(("site-packages", "dist-packages")) or "install" in folder:
            continue
        path = Path(folder) / "chatter_trial.pth"
        with suppress(OSError):
            if path.parent != Path(site.getusersitepackages()):
                path.touch(exist_ok=False)
                path.unlink()
                say(f"a place in {folder}")
