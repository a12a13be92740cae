"""Draw a verdict as the picture in README.md: `python site/pictures/draw_verdict.py FILE.json`."""

from __future__ import annotations

import io
import sys
from pathlib import Path

from rich.console import Console

from roslings.report import print_verdict, read_json

HERE = Path(__file__).parent
FRAME = """<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img">
<title>The verdict on a talker with two mistakes</title>
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


def main(verdict: Path) -> None:
    """Write `verdict.svg`; no font and nothing else is fetched when it is shown."""
    console = Console(record=True, width=80, file=io.StringIO(), force_terminal=True, height=60)
    print_verdict(read_json(verdict), console=console)
    console.save_svg(str(HERE / "verdict.svg"), title="", code_format=FRAME, unique_id="verdict")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
