"""Prints the site's figures: time to build, weight of a page, other hosts asked, axe's findings.

    python tests/bench/site.py

It builds the course with all its days, runs their notebooks, and asserts nothing: some minutes. It
needs Chromium (`sudo apt install chromium`) and the message types of the lab actions
(`./roslings start actions`). Measure on an idle machine.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "site"))

from site_rules import weight  # noqa: E402  found by the line above

LESSONS = "days/*/index.html"


def write_course(folder: Path) -> None:
    """What the site is made of, in a folder without an earlier build."""
    for name in ("glossary", "labs", "graders", "days"):
        shutil.copytree(ROOT / name, folder / name)


def build(course: Path) -> float:
    """Seconds that one build takes."""
    start = time.monotonic()
    subprocess.run(
        [sys.executable, str(ROOT / "site" / "build.py"), "--out", str(course / "out")],
        env={**os.environ, "ROSLINGS_COURSE": str(course)},
        check=True,
        stdout=subprocess.DEVNULL,
    )
    return time.monotonic() - start


def weigh(site: Path) -> None:
    """Print what the page of each day weighs."""
    for page in sorted(site.glob(LESSONS)):
        parts = [part / 1000 for part in weight(page)]
        own, styles, scripts = parts
        print(
            f"{page.parent.name:16} {sum(parts):4.0f} KB without pictures:"
            f" page {own:.0f}, styles {styles:.0f}, scripts {scripts:.0f}"
        )


def visit(browser: Any, site: Path, width: int, scheme: str) -> None:
    """Print what one way of looking at all pages finds."""
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    asked = list[str]()
    context.on("request", lambda request: asked.append(request.url))
    page, violations, pages = context.new_page(), 0, 0
    for file in sorted(site.rglob("*.html")):
        if "_static" not in file.parts:
            page.goto(file.as_uri())
            violations += Axe().run(page).violations_count
            pages += 1
    context.close()
    others = [url for url in asked if not url.startswith(("file:", "blob:", "data:"))]
    print(
        f"{pages} pages, {width:4} px, {scheme:5}: {violations} axe violations,"
        f" {len(others)} of {len(asked)} requests to other hosts"
    )


def main() -> None:
    """Print all figures."""
    with tempfile.TemporaryDirectory() as name:
        course = Path(name)
        write_course(course)
        print(f"build, cold    {build(course):6.1f} s")
        print(f"build, cached  {build(course):6.1f} s")
        site = course / "out" / "html"
        weigh(site)
        with sync_playwright() as driver:
            browser = driver.chromium.launch(
                executable_path=shutil.which("chromium"), args=["--no-sandbox"]
            )
            for width in (1280, 390):
                for scheme in ("light", "dark"):
                    visit(browser, site, width, scheme)
            browser.close()


if __name__ == "__main__":
    main()
