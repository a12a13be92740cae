"""The instructors' guide, followed word by word: the lab that comes out is proven."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from roslings.course import Lab, lab, root
from roslings.course.task import write_task
from roslings.workspace.inspect import inspect_package
from roslings_class.release import leaks, release
from roslings_prove.consistency import files_fit
from roslings_prove.contract.promises import PromiseAccount, prove_promises
from roslings_prove.new_lab import new_lab
from roslings_prove.prove import Proof

GUIDE = root() / "site" / "pages" / "teachers" / "new-lab.md"


def blocks(language: str) -> list[str]:
    """The guide's code blocks of a language, in order."""
    return re.findall(rf"```{language}\n(.*?)```", GUIDE.read_text("utf-8"), re.DOTALL)


def replace(path: Path, *pairs: tuple[str, str]) -> None:
    """Put each second text in place of the first, which must be there."""
    text = path.read_text("utf-8")
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    path.write_text(text, "utf-8")


@pytest.fixture
def written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lab:
    """The lab that the guide writes, in a course of its own."""
    words = blocks("bash")[0].split()
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    made = new_lab(words[2], words[4], words[6])
    change_the_contract(made)
    add_a_check(made)
    write_task(lab(made.name))
    return lab(made.name)


def change_the_contract(made: Lab) -> None:
    """Step 3: the card, the solution, and the mutants that patch these lines."""
    card = made.folder / "card.yaml"
    text = card.read_text("utf-8")
    publishes = re.search(r"    publishes:\n.*?(?=\nends)", text, re.DOTALL)
    assert publishes
    card.write_text(text.replace(publishes[0], blocks("yaml")[0]), "utf-8")
    code = made.solution / "alarm" / "alarm.py"
    replace(code, ("'alive', 10", "'alarm_level', 10"), ("(1.0,", "(0.1,"), ("f'alive", "f'level"))
    mutants = made.folder / "mutants"
    replace(mutants / "wrong_topic.yaml", ("'alive', 10", "'alarm_level', 10"))
    replace(mutants / "rate_2_hz.yaml", ("(1.0,", "(0.1,"))


def add_a_check(made: Lab) -> None:
    """Step 4: check, points, hints and mutant."""
    with made.grader.open("a", encoding="utf-8") as grader:
        grader.write("\n\n" + blocks("python")[0])
    replace(made.folder / "card.yaml", ("  text: 15", "  text: 10\n  quiet: 5"))
    hints = made.folder / "hints.yaml"
    table = yaml.safe_load(hints.read_text("utf-8"))
    table["quiet"] = {"lesson": table["topic"]["lesson"], "steps": ["where", "idea", "code"]}
    hints.write_text(yaml.safe_dump(table), "utf-8")
    (made.folder / "mutants" / "second_publisher.yaml").write_text(blocks("yaml")[1], "utf-8")


def test_its_files_fit(written: Lab, tmp_path: Path) -> None:
    """As far as can be told without running it."""
    assert [proof.line for proof in files_fit(written) if not proof.holds] == []
    seen = inspect_package(written.solution, written.card)
    assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]
    for mutant in written.mutants():
        mutant.make(written.solution, tmp_path / "made" / mutant.name)
    assert "10 Hz; 9.5 Hz to 10.5 Hz" in written.task.read_text("utf-8")


def test_its_sentences_are_accounted_for(written: Lab) -> None:
    """As the example's are, with the new names."""
    found = list(prove_promises(written))
    assert [each.line for each in found if isinstance(each, Proof) and not each.holds] == []
    (account,) = (each for each in found if isinstance(each, PromiseAccount))
    assert account.accounted == account.sentences > 0


def test_its_words_are_english(written: Lab) -> None:
    """The example's package has another first letter."""
    assert written.card.title == "An alarm"
    texts = [path.read_text("utf-8") for path in written.folder.rglob("*") if path.is_file()]
    assert not re.search(r"\b[Aa] alarm", "\n".join(texts))


def test_it_is_released(written: Lab, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Step 6: what the example and this guide say to all is no secret; the rest is one."""
    for folder in ("example", "site/pages/teachers"):
        shutil.copytree(GUIDE.parents[3] / folder, root() / folder)
    edition = tmp_path_factory.mktemp("release") / "students"
    names = release(edition).names
    assert f"labs/{written.name}/task.md" in names
    own = [name for name in names if name.startswith("labs/")]
    assert not [name for name in own if "mutants" in name or "promises" in name]
    (edition / "leak.md").write_text("The level is one too high.", "utf-8")
    assert list(leaks(edition, [written])) == []
    mutant = written.folder / "mutants" / "own.yaml"
    mutant.write_text("what: The level is one too high.\nfails: [text]\n", "utf-8")
    assert list(leaks(edition, [lab(written.name)])) == ["leak.md tells a mutant of range-alarm"]


@pytest.mark.slow
def test_it_is_proven(written: Lab, tmp_path: Path) -> None:
    """Every package of it is graded for real, and each word and sentence is judged."""
    assert yaml.safe_load(blocks("yaml")[2]).items() <= _mutant(written, "best_effort").items()
    command = [sys.executable, "-m", "roslings", "prove", written.name]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"(\d+) of \1 words of the card are judged \(100%\)", done.stdout)
    assert re.search(r"(\d+) of \1 sentences of the task are accounted for", done.stdout)


def _mutant(lab: Lab, name: str) -> dict[str, object]:
    found: dict[str, object] = yaml.safe_load(
        (lab.folder / "mutants" / f"{name}.yaml").read_text("utf-8")
    )
    return found
