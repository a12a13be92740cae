"""The picture of the graph: its pixels, its text alternative, its file."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest
import written_graphs as written
from PIL import Image, ImageChops

from ros2_on_pip.graph.labels import labels_of
from ros2_on_pip.graph.line import INK, WARNING
from ros2_on_pip.graph.shape import shape_of
from ros2_on_pip.graph.words import describe_graph
from roslings.evidence import GraphSeen
from roslings.report.graph_picture import NotAPng, draw_graph
from roslings.report.graph_sheet import NODE_FILL, TOPIC_FILL
from roslings.report.lettering import Lettering
from roslings.report.whole_file import CannotWriteFile

GRAPHS = {
    "empty": written.empty(),
    "one": written.one(),
    "two": written.two(),
    "five": written.five(),
    "loop": written.loop(),
    "twelve": written.twelve(),
    "long names": written.long_names(),
}


def drawn(graph: GraphSeen, path: Path, title: str | None = None) -> Image.Image:
    """The picture, as it is read back."""
    draw_graph(graph, path, title=title)
    picture: Image.Image = Image.open(path)
    picture.load()
    return picture


def colours(picture: Image.Image) -> dict[str, int]:
    """Colour, as in HTML, to its number of pixels."""
    plain = picture.convert("RGB")
    found = plain.getcolors(plain.width * plain.height) or []
    return {"#%02x%02x%02x" % colour: count for count, colour in found if isinstance(colour, tuple)}  # noqa: UP031


@pytest.mark.parametrize("name", GRAPHS)
def test_a_png_that_the_figure_check_takes(name: str, tmp_path: Path) -> None:
    """At least 200 by 200 px, not of one colour, with a white rim: nothing is cut."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a letter that no font has would warn
        picture = drawn(GRAPHS[name], tmp_path / "graph.png", title="Übung: $x_1$ und 图")
    assert picture.format == "PNG"
    assert picture.width >= 200
    assert picture.height >= 200
    assert len(colours(picture)) > 10
    plain = picture.convert("RGB")
    inside = ImageChops.difference(plain, Image.new("RGB", plain.size, "white")).getbbox()
    assert inside is not None
    assert inside[0] > 10
    assert inside[1] > 10
    assert inside[2] < plain.width - 10
    assert inside[3] < plain.height - 10


@pytest.mark.parametrize("name", GRAPHS)
def test_the_text_alternative_is_in_the_file(name: str, tmp_path: Path) -> None:
    """Description holds the sentences, letters that are not Latin included."""
    picture = drawn(GRAPHS[name], tmp_path / "graph.png", title="Grafo de María")
    assert picture.info["Description"] == describe_graph(GRAPHS[name])
    assert picture.info["Title"] == "Grafo de María"


def test_nodes_and_topics_differ_in_shape_and_colour(tmp_path: Path) -> None:
    """Two nodes and one topic: the corners of a topic are filled, those of a node are not."""
    count = colours(drawn(written.two(), tmp_path / "two.png"))
    assert count[NODE_FILL] > 2000
    assert count[TOPIC_FILL] > 2000
    empty = colours(drawn(written.empty(), tmp_path / "empty.png"))
    assert NODE_FILL not in empty
    assert TOPIC_FILL not in empty
    assert INK in empty


def test_an_arrow_joins_talker_topic_and_listener(tmp_path: Path) -> None:
    """From the first node's fill to the last one's, no column of pixels is white throughout."""
    picture = drawn(written.two(), tmp_path / "two.png").convert("RGB")
    band = picture.crop((0, 0, picture.width, picture.height - 120))
    blank = Image.new("RGB", (1, band.height), "white")
    dark = [
        x
        for x in range(band.width)
        if ImageChops.difference(band.crop((x, 0, x + 1, band.height)), blank).getbbox()
    ]
    assert dark == list(range(dark[0], dark[-1] + 1))
    assert dark[-1] - dark[0] > band.width / 2


def test_more_nodes_make_a_bigger_picture(tmp_path: Path) -> None:
    """It grows; the letters do not shrink."""
    small = drawn(written.two(), tmp_path / "two.png")
    big = drawn(written.twelve(), tmp_path / "twelve.png")
    assert big.width * big.height > 5 * small.width * small.height
    assert (tmp_path / "twelve.png").stat().st_size < 1_000_000


def test_two_nodes_of_one_name_are_shown_as_such(tmp_path: Path) -> None:
    """In words and with a second outline."""
    twice = written.graph([("/talker", "/chatter", written.STRING)], nodes=["/talker"])
    label = labels_of(shape_of(twice))["node /talker"]
    assert [line.text for line in label.lines] == ["/talker", "2 nodes of this name"]
    count = colours(drawn(twice, tmp_path / "twice.png"))
    assert count[WARNING] > 200
    assert WARNING not in colours(drawn(written.two(), tmp_path / "once.png"))


@pytest.mark.parametrize("name", GRAPHS)
def test_every_line_of_text_fits_its_box(name: str) -> None:
    """Corners of the text lie within the ellipse or the rectangle."""
    lettering = Lettering()
    for label in labels_of(shape_of(GRAPHS[name])).values():
        box = label.box(lettering)
        top = -label.height / 2
        for line in label.lines:
            across = lettering.width(line) / box.width
            down = max(abs(top), abs(top + line.height)) / (box.height / 2)
            top += line.height
            assert (across**2 + down**2 < 1) if label.round else (across < 1 and down < 1)


def test_namespaces_are_visible() -> None:
    """A node's full name stands in its box."""
    lines = labels_of(shape_of(written.five()))["node /robot1/camera"].lines
    assert lines[0].text == "/robot1/camera"


@pytest.mark.parametrize(("front", "ground"), [(INK, NODE_FILL), (INK, TOPIC_FILL)])
def test_text_has_contrast(front: str, ground: str) -> None:
    """At least 7:1, by the formula of WCAG 2.2; so has the warning."""
    assert contrast(front, ground) > 7
    assert contrast(WARNING, ground) > 7


def contrast(one: str, other: str) -> float:
    """From 1 to 21."""
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


def luminance(colour: str) -> float:
    """Relative luminance as WCAG 2.2 defines it."""
    parts = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    ]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_it_never_overwrites_unasked(tmp_path: Path) -> None:
    """The student's own picture stays; with `overwrite` it is replaced whole."""
    path = tmp_path / "figures ü" / "day3_rqt_graph.png"
    path.parent.mkdir()
    path.write_bytes(b"mine")
    with pytest.raises(FileExistsError, match=r"there already\. Give another name"):
        draw_graph(written.two(), path)
    assert path.read_bytes() == b"mine"
    draw_graph(written.two(), path, overwrite=True)
    assert path.read_bytes().startswith(b"\x89PNG")
    assert [entry.name for entry in path.parent.iterdir()] == [path.name]


@pytest.mark.parametrize("name", ["graph.jpg", "graph", "graph.png.txt"])
def test_the_name_says_png(name: str, tmp_path: Path) -> None:
    """A PNG under another name would lie."""
    with pytest.raises(NotAPng, match=r"ends in \.png"):
        draw_graph(written.two(), tmp_path / name)


def test_a_folder_that_is_not_there_is_made(tmp_path: Path) -> None:
    """One command is enough."""
    draw_graph(written.two(), tmp_path / "new" / "figures" / "graph.png")
    assert (tmp_path / "new" / "figures" / "graph.png").is_file()


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path) -> None:
    """A file has its name."""
    (tmp_path / "figures").touch()
    with pytest.raises(CannotWriteFile, match="give a place where you may write"):
        draw_graph(written.two(), tmp_path / "figures" / "graph.png")


def test_two_drawings_of_one_graph_are_equal(tmp_path: Path) -> None:
    """No date and no chance in it."""
    draw_graph(written.twelve(), tmp_path / "one.png")
    draw_graph(written.twelve(), tmp_path / "two.png")
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "two.png").read_bytes()
