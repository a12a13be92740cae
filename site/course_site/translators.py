"""A translator's files of the texts with ids: `languages/LANG/ROOM.yaml`, brought up to date.

What is not translated yet is empty. A translation of another English than today's is empty again:
what it said stands above it, as a comment. Those that fit no text any more go to `left_over.txt`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import yaml

from course_site.catalogue import Entry, entries, folder_of, merged, room_of, unknown
from ros2_on_pip.language import BadCatalogue, Translation, catalogue, read
from ros2_on_pip.problem import did_you_mean
from roslings.folders.course_folder import engine_root

HEAD = "# {room}, {language}: `says` is for people. What stands in {{braces}} and `code` stays.\n"
BEFORE = "# before: "
LEFT_OVER = "left_over.txt"


def require_known(course: Path, language: str) -> None:
    """Refuse a translation whose id no text has. Raises BadCatalogue."""
    wanted = entries(course)
    for each in unknown(catalogue(language), wanted):
        near = did_you_mean(each.id, wanted).strip()
        mend = " ".join([*filter(None, [near]), "./roslings site --catalogue writes all ids."])
        raise BadCatalogue(each.file, each.line, f"There is no text {each.id!r}.", mend)


def write_texts(course: Path, language: str) -> Iterator[str]:
    """Write all files of a language; a line for each, with how much is translated."""
    places = defaultdict[Path, list[Entry]](list)
    for entry in _own(entries(course).values(), course):
        folder = folder_of(entry, course) / language
        places[folder / f"{room_of(entry.id)}.yaml"].append(entry)
    known = _known({file.parent for file in places})
    for file, wanted in sorted(places.items()):
        texts, _ = merged(wanted, known)
        file.parent.mkdir(parents=True, exist_ok=True)
        head = HEAD.format(room=file.stem, language=language)
        file.write_text(head + "".join(_entries(wanted, texts, known)), "utf-8")
        done = sum(1 for _, says in texts.values() if says)
        yield f"{file}: {done} of {len(texts)}"
    all_wanted = [entry for of_file in places.values() for entry in of_file]
    yield from _kept(merged(all_wanted, known)[1], course / "site/languages" / language)


def _own(found: Iterable[Entry], course: Path) -> list[Entry]:
    """What this course can translate: of another one than the engine's, only what is its own."""
    return [each for each in found if each.home == "course" or course == engine_root()]


def _known(folders: Iterable[Path]) -> dict[str, Translation]:
    """What is translated already, wherever it lies. Raises BadCatalogue."""
    files = sorted(file for folder in folders for file in folder.glob("*.yaml"))
    return {each.id: each for file in files for each in read(file)}


def _entries(
    wanted: Sequence[Entry],
    texts: Mapping[str, tuple[str, str]],
    known: Mapping[str, Translation],
) -> Iterator[str]:
    for entry in wanted:
        english, says = texts[entry.id]
        yield f"\n# {entry.where}\n"
        old = known.get(entry.id)
        if old and old.says and not says:
            yield "".join(f"{BEFORE}{line}\n" for line in old.says.splitlines())
        yield yaml.safe_dump(
            {entry.id: {"en": english, "says": says}},
            allow_unicode=True,
            sort_keys=False,
            width=90,
        )


def _kept(left_over: Sequence[Translation], folder: Path) -> Iterator[str]:
    """Translations of texts that are gone: nobody's work is thrown away."""
    if left_over:
        folder.mkdir(parents=True, exist_ok=True)
        file = folder / LEFT_OVER
        with file.open("a", encoding="utf-8") as text:
            text.writelines(f"{each.id}\n  {each.english}\n  {each.says}\n" for each in left_over)
        yield f"{file}: {len(left_over)} that fit no text any more"
