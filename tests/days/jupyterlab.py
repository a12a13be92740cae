"""A real JupyterLab, started as `./roslings lab` does, in a real browser."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

PATIENCE_MS = 600_000


OUR_COMMAND = (sys.executable, "-m", "roslings")


@contextmanager
def served(
    day: str, variables: dict[str, str], cwd: Path, command: Sequence[str | Path] = OUR_COMMAND
) -> Iterator[str]:
    """`./roslings lab DAY --no-browser`, until the block ends; gives its address."""
    with serving([*command, "lab", day, "--no-browser"], variables, cwd) as address:
        yield address


@contextmanager
def serving(words: Sequence[str | Path], variables: dict[str, str], cwd: Path) -> Iterator[str]:
    """A program that serves JupyterLab, until the block ends; gives its address."""
    with subprocess.Popen(
        words,
        env=variables,
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    ) as server:
        try:
            yield _address(server)
        finally:
            server.send_signal(signal.SIGTERM)
            _end(server)


def _address(server: subprocess.Popen[str]) -> str:
    said = []
    assert server.stdout is not None
    for line in server.stdout:
        said.append(line)
        if found := re.search(r"http://127\.0\.0\.1:\S+", line):
            return found[0]
    raise AssertionError("JupyterLab did not start:\n" + "".join(said))


def _end(server: subprocess.Popen[str]) -> None:
    """The group: server and kernels."""
    try:
        server.wait(10)
    except subprocess.TimeoutExpired:
        server.kill()
    finally:
        with suppress(ProcessLookupError):
            os.killpg(server.pid, signal.SIGKILL)


class Lab:
    """The page of JupyterLab with a notebook."""

    def __init__(self, browser: Any, address: str) -> None:
        self.page = browser.new_page(viewport={"width": 1280, "height": 900})
        self.page.set_default_timeout(PATIENCE_MS)
        self._ready = False
        self.page.on("websocket", self._listen)
        self.page.goto(address)

    def _listen(self, socket: Any) -> None:
        socket.on("framereceived", self._hear)

    def _hear(self, frame: Any) -> None:
        content = frame if isinstance(frame, bytes) else str(frame).encode()
        self._ready = self._ready or b"kernel_info_reply" in content

    def wait_for_kernel(self) -> None:
        """Before that, Run All silently does nothing: the toolbar says idle too early."""
        self.page.locator(".jp-Notebook .jp-Cell").first.wait_for()
        for _ in range(PATIENCE_MS // 100):
            if self._ready and self.page.locator("text=| Idle").count():
                return
            self.page.wait_for_timeout(100)
        raise AssertionError("the kernel never got ready")

    def run_all(self) -> None:
        """Run all cells, and wait until the last one has ended."""
        self.page.locator("text=Run").first.click()
        self.page.locator(".lm-Menu-itemLabel", has_text=re.compile("^Run All Cells$")).click()
        for _ in range(PATIENCE_MS // 100):
            prompts = self.prompts()
            if prompts and all(re.fullmatch(r"\[\d+\]:", each) for each in prompts):
                return
            self.page.wait_for_timeout(100)
        raise AssertionError(f"the cells did not end: {self.prompts()}")

    def prompts(self) -> list[str]:
        """What stands before each code cell: `[3]:` once it has run."""
        return [text.strip() for text in self._all(".jp-CodeCell .jp-InputPrompt")]

    def failed(self, file: Path) -> list[str]:
        """The ids of the cells that raised something, as the saved `file` has them.

        On the page an error looks as what a program writes to stderr.
        """
        self.page.keyboard.press("Control+s")
        for _ in range(PATIENCE_MS // 100):
            cells = [cell for cell in _cells_in(file) if "outputs" in cell]
            if cells and all(cell["execution_count"] for cell in cells):
                kinds = {c["id"]: {out["output_type"] for out in c["outputs"]} for c in cells}
                return [name for name, found in kinds.items() if "error" in found]
            self.page.wait_for_timeout(100)
        raise AssertionError("the notebook was not saved")

    def alts(self) -> list[str]:
        """The text alternatives of all pictures, drawn or made by cells."""
        pictures = self.page.locator(".jp-Notebook img").all()
        return [str(picture.get_attribute("alt") or "") for picture in pictures]

    def outputs(self) -> str:
        """All that stands below the cells."""
        return "\n".join(self._all(".jp-OutputArea-output"))

    def _all(self, selector: str) -> list[str]:
        return [str(text) for text in self.page.locator(selector).all_text_contents()]


def _cells_in(file: Path) -> list[dict[str, Any]]:
    """The cells of a notebook; none while it is being written."""
    try:
        cells: list[dict[str, Any]] = json.loads(file.read_text("utf-8"))["cells"]
    except json.JSONDecodeError:
        return []
    return cells
