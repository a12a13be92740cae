"""Draw a verdict as it looks in a terminal: `python site/pictures/draw_verdict.py JSON SVG TITLE`.

README.md shows `site/pictures/verdict.svg`, and the first 15 minutes show
`days/01-install/pictures/one-letter.svg`, drawn from `site/pictures/verdict.json`.
"""

from __future__ import annotations

import io
import sys
from html import escape
from pathlib import Path

from rich.console import Console

from roslings.report.json_file import read_json
from roslings.report.terminal import print_verdict

FRAME = """<svg class="terminal" xmlns="http://www.w3.org/2000/svg"
viewBox="0 0 {width} {height}" role="img">
<title>TITLE</title>
<style>
.{unique_id}-matrix {{ font-family: "DejaVu Sans Mono", Menlo, Consolas, monospace;
font-size: {char_height}px; line-height: {line_height}px; }}
{styles}
</style>
<defs>
<clipPath id="{unique_id}-clip-terminal">
<rect x="0" y="0" width="{terminal_width}" height="{terminal_height}" />
</clipPath>
{lines}
</defs>
<rect width="{width}" height="{height}" rx="8" fill="#292929"/>
<g transform="translate({terminal_x}, {terminal_y})" clip-path="url(#{unique_id}-clip-terminal)">
{backgrounds}
<g class="{unique_id}-matrix" xml:space="preserve">
{matrix}
</g>
</g>
</svg>
"""


def main(verdict: Path, picture: Path, title: str) -> None:
    """Write `picture`; no font and nothing else is fetched when it is shown."""
    console = Console(record=True, width=80, file=io.StringIO(), force_terminal=True, height=60)
    print_verdict(read_json(verdict), console=console)
    frame = FRAME.replace("TITLE", escape(title).replace("{", "{{").replace("}", "}}"))
    console.save_svg(str(picture), title="", code_format=frame, unique_id=picture.stem)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), sys.argv[3])
