"""Class lists and grading worksheets as they are written in other languages than English."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from test_batch_export import TOPICS, graded, refused

from roslings_class.errors import BadTable
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.headings import COLUMNS, PARTICIPANT, english, plain, table
from roslings_class.roster import match, read_roster

WORKSHEETS = {
    "de": (
        "ID",
        "Vollständiger Name",
        "E-Mail-Adresse",
        "Status",
        "Bewertung",
        "Bestwertung",
        "Bewertung kann geändert werden",
        "Zuletzt geändert (Abgabe)",
        "Zuletzt geändert (Bewertung)",
        "Feedback als Kommentar",
        "Teilnehmer/in",
    ),
    "es": (
        "Identificador",
        "Nombre completo",
        "Dirección de correo",
        "Estado",
        "Calificación",
        "Calificación máxima",
        "La calificación puede ser cambiada",
        "Última modificación (entrega)",
        "Última modificación (calificación)",
        "Comentarios de retroalimentación",
        "Participante ",
    ),
    "fr": (
        "Identifiant",
        "Nom complet",
        "Adresse de courriel",
        "Statut",
        "Note",
        "Note maximale",
        "La note peut être modifiée",
        "Dernière modification (travail remis)",
        "Dernière modification (note)",
        "Feedback par commentaires",
        "Participant",
    ),
    "pt": (
        "Identificador",
        "Nome completo",
        "Endereço de email",
        "Status",
        "Nota",
        "Nota máxima",
        "Nota pode ser alterada",
        "Última modificação (envio)",
        "Última modificação (nota)",
        "Comentários de feedback",
        "Participante",
    ),
    "zh": (
        "标识符",
        "全名",
        "电子邮件地址",
        "状态",
        "成绩",
        "最高分",
        "可以更改成绩",
        "上次修改（作业）",  # noqa: RUF001
        "上次修改（评分）",  # noqa: RUF001
        "反馈评语",
        "参与人",
    ),
}
"""The head as Moodle writes it, and the word before the number."""
GRADE, FEEDBACK = 4, 9


def worksheet(language: str) -> str:
    """One of two students, with a decimal comma."""
    *head, word = WORKSHEETS[language]
    lines = [
        head,
        [f"{word}101", "Anna Berg", "a@example.org", "x", "", "20,00", "x", "-", "-", ""],
        [f"{word}1020", "王 明", "w@example.org", "x", "", "20,00", "x", "-", "-", ""],
    ]
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(lines)
    return text.getvalue()


@pytest.mark.parametrize("language", WORKSHEETS)
@pytest.mark.parametrize("names", [("Anna Berg", "王明"), ("x", "y")])
def test_a_worksheet_in_its_language_finds_all_and_goes_back(
    language: str, names: tuple[str, str], tmp_path: Path
) -> None:
    """Its head stays, its points are those of the assignment; the number alone is enough."""
    anna, wang = names
    (tmp_path / "sheet.csv").write_text(worksheet(language), "utf-8")
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "sheet.csv"))
        book.write(graded(f"{anna}_101_assignsubmission_file", "figure"))
        book.write(refused(f"{wang}_1020_assignsubmission_file", "There is no package."))
        told = "\n".join(hand_out(book, TOPICS, tmp_path))
    assert "moodle.csv" in told and "Of nobody" not in told and "nothing" not in told
    lines = list(csv.reader((tmp_path / "moodle.csv").read_text("utf-8").splitlines()))
    assert tuple(lines[0]) == WORKSHEETS[language][:-1]
    assert [line[GRADE] for line in lines[1:]] == ["19,60", ""]
    assert ["About figure." in lines[1][FEEDBACK], lines[2][FEEDBACK]] == [
        True,
        "There is no package.",
    ]


@pytest.mark.parametrize(
    ("head", "line", "name", "number"),
    [
        ("Vorname;Nachname;Matrikelnummer", "Anna;Berg;7001", "Anna Berg", "7001"),
        ("Name;Vorname;Matr.-Nr.", "Berg;Anna;7001", "Anna Berg", "7001"),
        ("Nom,Prénom,Matricule", "Berg,Anna,7001", "Anna Berg", "7001"),
        ("Nom,Courriel", "Anna Berg,a@example.org", "Anna Berg", ""),
        ("Nombre,Apellido(s),Número de ID", "Anna,Berg,7001", "Anna Berg", "7001"),
        ("Nome,Sobrenome,Matrícula", "Anna,Berg,7001", "Anna Berg", "7001"),
        ("Name,First name", "Anna Berg,Anna", "Anna Berg", ""),
        ("姓,名,学号", "王,小明,7001", "王小明", "7001"),
        ("姓名,学号", "王明,7001", "王明", "7001"),
        ("PRE\u0301NOM,NOM  DE  FAMILLE", "Anna,Berg", "Anna Berg", ""),
    ],
)
def test_a_class_list_is_read_in_its_language(
    head: str, line: str, name: str, number: str, tmp_path: Path
) -> None:
    """The parts of a name, in whatever order; the number that a school gives."""
    (tmp_path / "class.csv").write_text(f"{head}\n{line}\n", "utf-8")
    (student,) = read_roster(tmp_path / "class.csv")
    assert (student.name, student.id) == (name, number)
    assert match([student], [f"{name}_3_assignsubmission_file"]).of_student[student]


def test_a_name_of_two_signs_is_a_name_and_one_of_two_letters_is_none(tmp_path: Path) -> None:
    """Two Chinese signs are as sure as many letters; `Li` may be a part of anything."""
    (tmp_path / "class.csv").write_text("name,id\n王明,1\nLi,2\n", "utf-8")
    students = read_roster(tmp_path / "class.csv")
    found = match(students, ["王明", "Li"])
    assert [found.of_student[each] for each in students] == [["王明"], []]


def test_a_list_of_which_no_column_is_known_says_where_to_add_it(tmp_path: Path) -> None:
    """With its columns, and the table."""
    (tmp_path / "class.csv").write_text("Jméno,Příjmení\nAnna,Berg\n", "utf-8")
    with pytest.raises(BadTable, match="'jméno', 'příjmení'") as refusal:
        read_roster(tmp_path / "class.csv")
    assert "headings.yaml" in refusal.value.next_step


def test_what_canvas_writes_above_the_students_is_no_student(tmp_path: Path) -> None:
    """Points, and which assignments are posted by hand; `Mutedza` is a name."""
    text = (
        "Student,ID,SIS User ID,SIS Login ID,Section,Lab 3 (48151)\n"
        ",,,,,Manual Posting\n"
        "    Points Possible,,,,,20.00\n"
        '"Mutedza, Ada",12,s1001,ada,S1,\n'
    )
    (tmp_path / "canvas.csv").write_text(text, "utf-8")
    assert [each.name for each in read_roster(tmp_path / "canvas.csv")] == ["Mutedza, Ada"]


def test_the_table_translates_known_columns_and_no_heading_has_two_meanings() -> None:
    """Whoever adds a language is told by this test what is wrong."""
    meanings: dict[str, set[str]] = {}
    for language, own in table().items():
        assert own.keys() <= {*COLUMNS, PARTICIPANT}, language
        for meant, headings in own.items():
            assert headings, (language, meant)
            for heading in headings if meant != PARTICIPANT else ():
                meanings.setdefault(plain(heading), set()).add(meant)
    assert {heading: meant for heading, meant in meanings.items() if len(meant) > 1} == {}
    assert {
        heading: meant
        for heading, meant in meanings.items()
        if heading in COLUMNS and meant != {heading}
    } == {}


def test_of_two_that_mean_the_same_the_first_counts() -> None:
    """The second is kept as it is; what nobody knows, too."""
    assert english(["Courriel", "Adresse e-mail", "Ville"]) == [
        "email address",
        "adresse e-mail",
        "ville",
    ]
