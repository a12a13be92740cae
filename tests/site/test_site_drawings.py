"""The rover stands in each lesson and each lab, in one style, with the names of their cards."""

from __future__ import annotations

import hashlib
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as Xml
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, root
from roslings_learn.lessons.document import read
from roslings_learn.lessons.path import Path as DayPath
from roslings_learn.lessons.rules.alternatives import own_words, untold
from roslings_learn.lessons.rules.links import faults_of_svg

sys.path += [str(root() / "site"), str(root() / "site" / "pictures")]
from course_site.picture_sizes import (
    LEAST_TEXT_PX,
    MOVES,
    least_width_px,
    smallest_text,
    still,
    width_of,
)
from draw_labs import DRAWN
from rover import TEAL

DRAW = root() / "site" / "pictures"
DAYS = read(root() / "days" / "path.yaml", DayPath).content.days
SHOWN = re.compile(r"!\[([^\]]*)\]\(pictures/([^)]+)\)")
NAMES = re.compile(r"(?<![\w/.])/[a-z]\w*(?:/\w+)*")
WIDEST_PX = 60 * 16
"""Nobody moves a drawing on a phone farther than that."""
ROOMS = ("days", "labs", "site/pages", "site/static")
each_lab = pytest.mark.parametrize("lab", all_labs(), ids=lambda lab: lab.name)
each_day = pytest.mark.parametrize("day", [day.id for day in DAYS])


def drawings() -> list[Path]:
    """Each drawing that some page shows."""
    found = (file for room in ROOMS for file in (root() / room).rglob("*.svg"))
    return sorted(file for file in found if "ruff_cache" not in str(file))


each_drawing = pytest.mark.parametrize(
    "drawing", drawings(), ids=lambda file: str(file.relative_to(root()))
)


def words_of_lesson(day: str) -> str:
    """All text of a lesson."""
    notebook = json.loads((root() / "days" / day / "lesson.ipynb").read_text("utf-8"))
    cells = (cell for cell in notebook["cells"] if cell["cell_type"] == "markdown")
    return "\n\n".join("".join(cell["source"]) for cell in cells)


def drawn(script: str, place: Path) -> None:
    """Run one of the scripts that draw."""
    paths = ":".join(str(each) for each in (root() / "packages").glob("*/src"))
    program = [sys.executable, str(DRAW / script), str(place)]
    subprocess.run(program, check=True, env={"PYTHONPATH": paths})


def same_files(made: Path, kept: Path, name: str) -> Iterator[str]:
    """What was made; each is looked up where it is kept."""
    for file in sorted(made.rglob(name)):
        place = file.relative_to(made)
        assert file.read_text("utf-8") == (kept / place).read_text("utf-8"), place
        yield place.parts[0]


# --- each drawing --------------------------------------------------------------------------------


@each_drawing
def test_its_letters_can_be_read_on_a_phone(drawing: Path) -> None:
    """As wide as a page shows it there at least, and no wider than one moves it sideways."""
    svg = drawing.read_text("utf-8")
    least = least_width_px(svg)
    assert least <= WIDEST_PX
    if least:
        assert smallest_text(svg) * least / width_of(svg) >= LEAST_TEXT_PX


def test_no_drawing_lies_there_twice() -> None:
    """Of each, there is one file; the page of all days has copies of what each lab shows."""
    own = (file for file in drawings() if not file.match("reference/pictures/my-rover-??.svg"))
    kept = Counter(hashlib.sha256(file.read_bytes()).hexdigest() for file in own)
    assert kept.most_common(1)[0][1] == 1


@each_day
def test_no_lesson_shows_a_drawing_twice(day: str) -> None:
    """Neither by its name nor by its title."""
    shown = [name for _, name in SHOWN.findall(words_of_lesson(day))]
    titles = [Xml.parse(root() / "days" / day / "pictures" / name).getroot() for name in shown]
    assert len(shown) == len(set(shown))
    assert len({each.findtext("{*}title") for each in titles}) == len(titles)


@each_day
def test_a_drawing_shows_what_its_own_page_runs(day: str) -> None:
    """Each name with a slash is one of the lesson's; what lies below such a name is one, too."""
    folder = root() / "days" / day
    pages = [file for end in ("*.md", "*.xml") for file in folder.glob(end)]
    told = "\n".join([all_of_lesson(day), *(page.read_text("utf-8") for page in pages), "rosout"])
    shown = [name for _, name in SHOWN.findall(words_of_lesson(day)) if name != "rover.svg"]
    foreign = {
        (name, node)
        for name in shown
        for node in NAMES.findall(texts_of(folder / "pictures" / name))
        if not {node, node.strip("/").split("/")[0], node.rsplit("/")[-1]} & parts_of(told)
    }
    assert foreign == set()


def all_of_lesson(day: str) -> str:
    """Text and programs."""
    notebook = json.loads((root() / "days" / day / "lesson.ipynb").read_text("utf-8"))
    return "\n".join("".join(cell["source"]) for cell in notebook["cells"])


def texts_of(drawing: Path) -> str:
    """What can be read in a drawing."""
    parts = Xml.parse(drawing).getroot().iter()
    return "\n".join("".join(each.itertext()) for each in parts if each.tag.endswith("}text"))


def parts_of(text: str) -> set[str]:
    """Words of programs and names."""
    return set(re.findall(r"\w+", text))


def test_smallest_letters_are_found_where_they_are() -> None:
    """In an attribute, in a style, and in a drawing within the drawing, as large as it is there."""
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 50">'
    assert smallest_text(f'{head}<text font-size="14"/><text font-size="9"/></svg>') == 9
    assert smallest_text(f"{head}<style>text {{ font: bold 12.5px serif }}</style></svg>") == 12.5
    assert smallest_text(f'{head}<text style="font-size: 8px"/></svg>') == 8
    assert least_width_px(f'{head}<text font-size="5.5"/></svg>') == 200
    assert least_width_px(f"{head}<rect/></svg>") == 0
    inner = f'{head}<text font-size="10"/></svg>'.encode().hex()
    from base64 import b64encode

    address = "data:image/svg+xml;base64," + b64encode(bytes.fromhex(inner)).decode()
    outer = f'{head}<text font-size="14"/><image width="50" href="{address}"/></svg>'
    assert smallest_text(outer) == 5


# --- the rover in each lesson --------------------------------------------------------------------


def test_the_rover_that_grows_is_drawn_by_its_program(tmp_path: Path) -> None:
    """A drawing a day; nobody edits one by hand."""
    drawn("draw_days.py", tmp_path)
    assert list(same_files(tmp_path, root() / "days", "rover.svg")) == [day.id for day in DAYS]


@each_day
def test_a_lesson_shows_the_rover_first(day: str) -> None:
    """Before any code, and told in words that stand in the drawing."""
    alternative, name = SHOWN.findall(words_of_lesson(day))[0]
    drawing = root() / "days" / day / "pictures" / name
    assert name == "rover.svg" and TEAL in drawing.read_text("utf-8")
    assert not list(faults_of_svg(drawing)) and untold(alternative, drawing) == []


@each_day
def test_its_nodes_are_those_of_the_days_labs(day: str) -> None:
    """Each name with a slash stands on a card of the day."""
    labs = [lab for lab in all_labs() if lab.card.day == day]
    cards = "\n".join((lab.folder / "card.yaml").read_text("utf-8") for lab in labs)
    named = set(NAMES.findall(own_words(root() / "days" / day / "pictures" / "rover.svg")))
    assert {name for name in named if not on_card(name, cards)} == set()
    assert bool(named) == any(lab.card.nodes for lab in labs)


def on_card(name: str, card: str) -> bool:
    """Also where the card has the parts of a name in two places: a namespace, and a node."""
    parts = name.rsplit("/", 1)
    return re.search(rf"{name}(?![\w/])", card) is not None or (
        bool(parts[0]) and all(re.search(rf"\b{part.strip('/')}\b", card) for part in parts)
    )


# --- what each lab makes move --------------------------------------------------------------------


def test_what_moves_is_drawn_by_its_program(tmp_path: Path) -> None:
    """A drawing a lab."""
    drawn("draw_labs.py", tmp_path)
    kept = list(same_files(tmp_path, root() / "labs", "moves.svg"))
    assert kept == sorted(DRAWN) == sorted(lab.name for lab in all_labs())


@each_lab
def test_a_task_begins_with_what_will_move(lab: Lab) -> None:
    """Before its card, in the words that are the drawing's title."""
    head, _, _ = lab.task.read_text("utf-8").partition("\n## ")
    ((alternative, name),) = SHOWN.findall(head)
    drawing = lab.folder / "pictures" / name
    assert Xml.parse(drawing).getroot().findtext("{*}title") == alternative
    svg = drawing.read_text("utf-8")
    assert MOVES in svg and "prefers-reduced-motion" in svg and "</style></svg>" in still(svg)
    assert TEAL in svg and 'font-size="14"' not in svg


@each_lab
def test_it_names_what_stands_on_the_card(lab: Lab) -> None:
    """Nodes, topics, services and actions; and at least one, where the card has nodes."""
    card = (lab.folder / "card.yaml").read_text("utf-8")
    named = set(NAMES.findall(own_words(lab.folder / "pictures" / "moves.svg")))
    assert {name for name in named if not on_card(name, card)} == set()
    assert bool(named) == bool(lab.card.nodes)


@each_lab
def test_its_numbers_stand_on_the_card(lab: Lab) -> None:
    """Speeds, distances and texts are the card's own, and not an older one's."""
    card = (lab.folder / "card.yaml").read_text("utf-8")
    drawing = Xml.parse(lab.folder / "pictures" / "moves.svg").getroot()
    said = [each.text or "" for each in drawing.iter() if each.tag.endswith("}text")]
    numbers = {float(n) for text in said for n in re.findall(r"\d+\.\d+", text)}
    assert numbers <= {float(n) for n in re.findall(r"\d+\.\d+", card)}


def test_the_room_of_the_front_page_is_drawn_by_its_program(tmp_path: Path) -> None:
    """The same rover."""
    drawn("draw_room.py", tmp_path / "rover.svg")
    kept = (root() / "site/static/rover.svg").read_text("utf-8")
    assert (tmp_path / "rover.svg").read_text("utf-8") == kept
    assert TEAL in kept and MOVES in kept


# --- a recorded terminal -------------------------------------------------------------------------

KEYS = root() / "days/01-install/pictures/keys.svg"


def test_the_recorded_terminal_is_what_the_program_shows(tmp_path: Path) -> None:
    """Rover, keys and screen of today; it ends at the ball, and no line is cut."""
    drawn("draw_keys.py", tmp_path / "keys.svg")
    assert (tmp_path / "keys.svg").read_text("utf-8") == KEYS.read_text("utf-8")
    last = KEYS.read_text("utf-8").rpartition('<g class="frame')[2]
    assert "The rover touches the red ball. Well done!" in last
    texts = [
        each.text or "" for each in Xml.parse(KEYS).getroot().iter() if each.tag.endswith("}text")
    ]
    assert max(map(len, texts)) <= 80


def test_the_first_15_minutes_show_it() -> None:
    """With the keys that it tells of."""
    page = (root() / "days/01-install/first-15-minutes.md").read_text("utf-8").lower()
    assert "(pictures/keys.svg)" in page
    for key in ("arrow up", "arrow left", "k"):
        assert key in page and f"key: {key}<" in KEYS.read_text("utf-8")
