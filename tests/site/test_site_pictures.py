"""Pictures are what the course's own programs draw, and say what their page says."""

from __future__ import annotations

import re
import subprocess
import sys
import xml.etree.ElementTree as Xml
from pathlib import Path

import my_rover_picture
import pytest

from roslings.course import all_labs, root
from roslings_learn.lessons.rules.alternatives import own_words, untold
from roslings_rover.models.rooms import KINDS, PASSAGE_M, PAST_M, room_of
from roslings_rover.rover.in_room import GIVES_UP_S, KEEPS_AWAY_M, STANDS_S
from roslings_rover.rover.room_markers import MARKERS, MOVING, ROOM

REFERENCE = root() / "site" / "pages" / "reference"
PICTURES = root() / "days" / "01-install" / "pictures"
DRAW = root() / "site" / "pictures"
TITLE = "A verdict: one letter is missing in the name of a topic"


def drawn(script: str, *words: str | Path) -> None:
    """Run one of the scripts that draw."""
    subprocess.run([sys.executable, str(DRAW / script), *map(str, words)], check=True)


def test_the_map_is_that_of_the_rover(tmp_path: Path) -> None:
    """The same room, and the way of a real drive."""
    drawn("draw_map.py", tmp_path / "map.svg")
    assert (tmp_path / "map.svg").read_text("utf-8") == (PICTURES / "map.svg").read_text("utf-8")


def test_the_verdict_is_what_the_terminal_shows(tmp_path: Path) -> None:
    """From the kept verdict, which the front page shows, too."""
    drawn("draw_verdict.py", DRAW / "verdict.json", tmp_path / "one-letter.svg", TITLE)
    told = (tmp_path / "one-letter.svg").read_text("utf-8")
    assert told == (PICTURES / "one-letter.svg").read_text("utf-8")
    assert "/alve" in told


# --- the whole robot, and its wires --------------------------------------------------------------

ROBOT = ("whole-robot.svg", "distance-sensor.svg", "motor-driver.svg")
SKETCH = root() / "labs/serial-bridge/firmware/rover_mega/rover_mega.ino"
SHOWN = re.compile(r"!\[([^\]]*)\]\(pictures/([^)]+)\)")


def page() -> str:
    """The page that shows them."""
    return (REFERENCE / "whole-robot.md").read_text("utf-8")


def test_the_robot_is_drawn_by_its_program(tmp_path: Path) -> None:
    """Nobody edits the drawings by hand."""
    drawn("draw_robot.py", tmp_path)
    assert sorted(each.name for each in tmp_path.iterdir()) == sorted(ROBOT)
    for name in ROBOT:
        own = (tmp_path / name).read_text("utf-8")
        assert own == (REFERENCE / "pictures" / name).read_text("utf-8")


@pytest.mark.parametrize("name", ROBOT)
def test_a_drawing_of_the_robot_can_be_read(name: str) -> None:
    """As wide as those of lessons, letters of 11 px or more on a phone, all of it on the card."""
    drawing = Xml.parse(REFERENCE / "pictures" / name).getroot()
    left, top, width, height = map(float, drawing.attrib["viewBox"].split())
    assert (left, top, width) == (0, 0, 720)
    texts = [each for each in drawing.iter() if each.tag.endswith("}text")]
    on_a_phone = 34 * 16 / width  # min-width of course.css
    assert min(float(each.attrib["font-size"]) for each in texts) * on_a_phone >= 11
    for each in texts:
        assert 0 < float(each.attrib["x"]) < width and 0 < float(each.attrib["y"]) < height


def test_the_page_tells_the_drawings_that_it_shows() -> None:
    """Each in words that stand in the drawing."""
    shown = {name: alternative for alternative, name in SHOWN.findall(page())}
    assert set(shown) == set(ROBOT)
    for name, alternative in shown.items():
        assert untold(alternative, REFERENCE / "pictures" / name) == []


def test_the_whole_robot_has_the_names_of_the_labs() -> None:
    """Each node and topic that is drawn stands on a card."""
    cards = "\n".join((lab.folder / "card.yaml").read_text("utf-8") for lab in all_labs())
    told = own_words(REFERENCE / "pictures" / "whole-robot.svg")
    names = set(re.findall(r"(?<![\w/])/\w+(?:/\w+)*", told))
    assert {"/guard", "/cmd_vel", "/camera/image_raw", "/drive_to"} <= names
    assert [name for name in names if not re.search(rf"{name}(?![\w/])", cards)] == []


def test_the_motor_driver_is_wired_as_the_sketch_wants_it() -> None:
    """PWM and direction of each motor; and what the page adds finds its place once."""
    sketch = SKETCH.read_text("utf-8")
    told = own_words(REFERENCE / "pictures" / "motor-driver.svg")
    for side, partner in (("left", 24), ("right", 25)):
        pins = re.search(rf"Wheel {side} = {{(\d+), (\d+),", sketch)
        assert pins is not None
        pwm, direction = map(int, pins.groups())
        assert f"{pwm}, {direction}, {partner}" in told and direction + 2 == partner
    for place in (
        "pinMode(wheel.directionPin, OUTPUT)",
        "digitalWrite(wheel.directionPin, pwm < 0)",
    ):
        assert sketch.count(place) == 1 and place in page()
    used = {int(pin) for pin in re.findall(r"\b\d+\b", "".join(re.findall(r"= {(.*)};", sketch)))}
    assert not {24, 25} & used


def test_the_divider_makes_what_the_pi_bears() -> None:
    """5 V over 1 and 2 kilo-ohms."""
    assert "1 kΩ" in page() and "2 kΩ" in page()
    assert 3.0 < 5 * 2 / (1 + 2) < 3.4


def test_programs_of_the_page_print_what_it_says(tmp_path: Path) -> None:
    """The way of the sound, and one wrong bit in each kind of line."""
    blocks = re.findall(r"```(python|text)\n(.*?)```", page(), re.DOTALL)
    programs = [text for language, text in blocks if language == "python"]
    outputs = [text for language, text in blocks if language == "text"]
    assert len(programs) == len(outputs) == 2
    for program, output in zip(programs, outputs, strict=True):
        (tmp_path / "lines.py").write_text(program, "utf-8")
        ran = [sys.executable, str(tmp_path / "lines.py")]
        assert subprocess.run(ran, capture_output=True, text=True, check=True).stdout == output


# --- a rover that grows --------------------------------------------------------------------------


def test_the_rover_of_parts_is_drawn_by_its_program() -> None:
    """As the terminal shows it; README and page show the same, with the same words."""
    assert my_rover_picture.picture() == my_rover_picture.PICTURE.read_text("utf-8")
    place = my_rover_picture.PICTURE.relative_to(root())
    readme = (root() / "README.md").read_text("utf-8")
    page_of_it = (REFERENCE / "my-rover.md").read_text("utf-8")
    assert f"![{my_rover_picture.ALT}]({place})" in readme
    assert f"![{my_rover_picture.ALT}](pictures/{place.name})" in page_of_it
    for line in my_rover_picture.screen():
        assert len(line) <= 80


# --- rooms from their seeds ----------------------------------------------------------------------


def test_the_rooms_are_drawn_by_their_program(tmp_path: Path) -> None:
    """Ten, of all kinds; the page shows them, in words that stand in the drawing."""
    drawn("draw_rooms.py", tmp_path / "rooms.svg")
    kept = REFERENCE / "pictures" / "rooms.svg"
    assert (tmp_path / "rooms.svg").read_text("utf-8") == kept.read_text("utf-8")
    shown = dict(map(reversed, SHOWN.findall((REFERENCE / "my-rover.md").read_text("utf-8"))))
    assert untold(shown["rooms.svg"], kept) == []
    seeds = [int(seed) for seed in re.findall(r">Room (\d+): ", kept.read_text("utf-8"))]
    assert len(seeds) == len(set(seeds)) == 10
    assert {room_of(seed).kind for seed in seeds} == set(KINDS)


def test_how_a_rover_sees_is_drawn_by_its_program(tmp_path: Path) -> None:
    """Day 11's drawings: nobody edits one by hand, and each room that it names is drawn."""
    drawn("draw_scans.py", tmp_path)
    kept = root() / "days" / "11-rooms" / "pictures"
    names = {each.name for each in tmp_path.iterdir()}
    assert names | {"rover.svg"} == {each.name for each in kept.iterdir()}
    for name in names:
        assert (tmp_path / name).read_text("utf-8") == (kept / name).read_text("utf-8"), name
    seeds = re.findall(r">Room (\d+): ", (kept / "rooms.svg").read_text("utf-8"))
    lesson = (kept.parent / "lesson.ipynb").read_text("utf-8")
    assert len(seeds) == 10 and set(re.findall(r"drive\((\d+),", lesson)) <= set(seeds)


def test_frames_are_drawn_by_their_program(tmp_path: Path) -> None:
    """Day 12's drawings, all of them; the lesson reckons with the same nail and the same square."""
    drawn("draw_frames.py", tmp_path)
    kept = root() / "days" / "12-frames" / "pictures"
    names = {each.name for each in tmp_path.iterdir()}
    assert names | {"rover.svg"} == {each.name for each in kept.iterdir()}
    for name in names:
        assert (tmp_path / name).read_text("utf-8") == (kept / name).read_text("utf-8"), name
    lesson = (kept.parent / "lesson.ipynb").read_text("utf-8")
    assert "rover = (1.0, 2.0, math.radians(degrees))" in lesson
    assert "x 1, y 4" in own_words(kept / "nail.svg") and "in the room 1.0, 4.0" in lesson
    assert "index = row * width + column" in own_words(kept / "grid.svg")


def test_the_page_tells_the_figures_of_rooms() -> None:
    """How wide a way is, how near what moves comes, how long it waits and a bump lasts."""
    text = (REFERENCE / "my-rover.md").read_text("utf-8").partition("## Rooms that")[2]
    told = " ".join(text.split())
    assert f"No way is narrower than {PASSAGE_M:g} m" in told
    assert f"{PAST_M:g} m are free beside them" in told
    assert f"They stop {KEEPS_AWAY_M:g} m before the rover" in told
    assert f"turn round after {GIVES_UP_S:g} s" in told
    assert f"Each one stops the rover for {STANDS_S:g} s" in told
    assert (
        f"On `{ROOM}` the rover says" in told and f"`{MOVING}` what moves, as `{MARKERS}`" in told
    )


def test_each_room_is_drawn_whole() -> None:
    """All that stands there and all that moves, and the signs of the legend."""
    drawing = (REFERENCE / "pictures" / "rooms.svg").read_text("utf-8")
    rooms = [room_of(int(seed)) for seed in re.findall(r">Room (\d+): ", drawing)]
    tracks = sum(len(room.tracks) for room in rooms)
    assert drawing.count('class="track"') == tracks
    things = sum(len(room.world.obstacles) for room in rooms)
    assert drawing.count('fill="#c3d5d3" stroke="#263238"') == things
