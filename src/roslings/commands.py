"""What each command does: call the rooms in order, and print what they return."""

from __future__ import annotations

import argparse
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from contextlib import closing, suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roslings import course
from roslings.cli import EXIT_OF_OUTCOME, FAILED, INCONCLUSIVE, OK, WRONG_USE
from roslings.course import Lab, NoSolution
from roslings.typed import program
from roslings.workspace.student import package_of, workspace_root
from roslings.workspace.trouble import WorkspaceError, shown

if TYPE_CHECKING:
    from roslings.batch.grades import LateRule
    from roslings.checking import Ready
    from roslings.evidence import GraphSeen
    from roslings.saving import Graded
    from roslings.verdict import Verdict
    from roslings.workspace.progress import LabStatus

SITE_WORDS = ("open", "fresh", "links", "check_links")


# --- check -------------------------------------------------------------------------------------


def check(options: argparse.Namespace) -> int:
    """Run what the student built, and say what to do next; a hint needs no new run."""
    from roslings.platforms import refusal_written, shapes_asked

    lab = course.lab(options.lab, options.hidden)
    if options.hint and not options.solution and _kept(lab).is_file():
        return _hint(lab, options)
    if not shapes_asked(options):
        return _check(lab, options)
    with refusal_written(lab.name, options, [options.path or workspace_root()]):
        return _check(lab, options)


def _hint(lab: Lab, options: argparse.Namespace) -> int:
    """A hint for what the last check found. Raises NothingToSave."""
    if options.evidence or options.html:
        from roslings.saving import NothingToSave

        raise NothingToSave
    return _show(_read(_kept(lab)), options)


def _check(lab: Lab, options: argparse.Namespace) -> int:
    from roslings.platforms import for_others, handed_in

    if options.solution:
        return _check_package(lab, _solution(lab), options)
    with handed_in(lab, options.path, for_others(options)) as package:
        return _check_package(lab, package, options)


def _check_package(lab: Lab, package: Path, options: argparse.Namespace) -> int:
    from roslings.checking import any_seed, ready
    from roslings.experiment import Choices, insist_on_wall
    from roslings.platforms import for_others
    from roslings.saving import place_for_bags
    from roslings.timeline import process_began_ns

    quiet = _is_stdout(options.json)
    others = for_others(options)
    strangers = others and not (options.solution or options.trust)
    if strangers:
        insist_on_wall(lab)
    _try_port(lab, options.port)
    with place_for_bags(options.evidence, package) as bags:
        seed = any_seed() if options.seed is None else options.seed
        choices = Choices(
            seed, options.clock, bags, options.port, options.hidden, strangers=strangers,
            for_others=others, soak_s=_soak_s(lab, options, others),
        )  # fmt: skip
        with ready(lab, choices) as begun:
            graded = begun.grade(package, process_began_ns(), quiet)
        before = None if options.solution else _replace_kept(lab, graded.verdict)
        code = _show(graded.verdict, options, before)
        if options.timings:
            _show_timings(graded, options)
        _save(graded, options, bags)
    return code


def _show_timings(graded: Graded, options: argparse.Namespace) -> None:
    from rich.console import Console

    from roslings.report.timings import print_timings

    console = Console(stderr=_is_stdout(options.json))
    print_timings(graded.evidence.timeline, graded.verdict.seconds, console)


def _soak_s(lab: Lab, options: argparse.Namespace, others: bool) -> float:
    """A student's own check is to be quick; where the result counts, nodes are left running."""
    from roslings.course.soak import soak_seconds

    return soak_seconds(lab.card, options.soak if others else options.soak or 0.0)


def _solution(lab: Lab) -> Path:
    """The course's own package. Raises NoSolution in the students' edition."""
    if not lab.solution.is_dir():
        raise NoSolution(lab.name)
    return lab.solution


def _try_port(lab: Lab, port: Path | None) -> None:
    """A real board is tried before anything is built."""
    if port is None:
        return
    from roslings.devices.board.attached import LabHasNoBoard, try_port

    if not lab.card.board:
        raise LabHasNoBoard(lab.name)
    try_port(port)
    print("The wheels will turn: put the rover on a stand, wheels in the air.", file=sys.stderr)


def _save(graded: Graded, options: argparse.Namespace, bags: Path | None) -> None:
    """Save what was asked for, and say where it is."""
    from roslings.saving import save

    if options.html:
        graded.write_page(options.html)
    if options.evidence:
        save(graded, options.evidence, bags)
        say = f"\nThe evidence is in {shown(options.evidence)}. Look at it in a browser:"
        page = shown(options.evidence / "report.html")
        print(f"{say}\n{page}", file=sys.stderr if _is_stdout(options.json) else sys.stdout)


def regrade(options: argparse.Namespace) -> int:
    """Judge saved evidence again, of one check or of a whole class; nothing is run."""
    from roslings.batch.gradebook import lab_of
    from roslings.batch.later import regrade_all
    from roslings.judge import judge
    from roslings.report import read_evidence
    from roslings.saving import Graded

    if lab_of(options.evidence):
        print("\n".join(regrade_all(options.evidence, options.lab, options.hidden)))
        return OK
    lab = course.lab(options.lab, options.hidden)
    evidence = read_evidence(options.evidence, lab.name)
    verdict = judge(lab, evidence)
    if options.html:
        Graded(lab, verdict, evidence).write_page(options.html)
    return _show(verdict, options)


def grade_all(options: argparse.Namespace) -> int:
    """Grade many submissions; 3 where some are still inconclusive."""
    from roslings.batch.command import Choices, grade

    choices = Choices(
        options.lab, options.submissions, options.out, jobs=options.jobs, hidden=options.hidden,
        trust=options.trust, clock=options.clock, limit_s=options.limit,
        roster=options.roster, rule=_late_rule(options), dask=options.dask,
        keeps_evidence=not options.dask or options.evidence, soak_s=options.soak,
        assignment=options.canvas_assignment,
    )  # fmt: skip
    try:
        report = grade(choices)
    except KeyboardInterrupt:
        print("\nWhat is graded is kept. The same command goes on from here.", file=sys.stderr)
        raise
    print("\n".join(report.lines))
    return INCONCLUSIVE if report.unclear else OK


def cluster(options: argparse.Namespace) -> int:
    """Run a part of a Dask cluster, in this environment, until Ctrl-C."""
    from roslings.batch.cluster import run_part

    return run_part(options.part, options.rest)


def _late_rule(options: argparse.Namespace) -> LateRule | None:
    from roslings.batch.grades import LateRule
    from roslings.batch.submissions import as_time
    from roslings.batch.trouble import BatchError

    if not options.deadline:
        return None
    try:
        deadline = as_time(options.deadline)
    except ValueError:
        problem = f"{options.deadline!r} is no date and time."
        raise BatchError(problem, "Write it as 2026-11-30T23:59.") from None
    return LateRule(
        deadline=deadline, points_a_day=options.late_points, free_days=options.late_free
    )


def override(options: argparse.Namespace) -> int:
    """Give a score by hand."""
    from roslings.batch.later import override as give

    told = give(options.folder, options.submission, options.score, options.reason, options.by)
    print("\n".join(told))
    return OK


def _show(verdict: Verdict, options: argparse.Namespace, before: Verdict | None = None) -> int:
    from rich.console import Console

    from roslings.platforms import write_shapes
    from roslings.report import print_verdict, write_json
    from roslings.typed import as_typed

    if options.json:
        write_json(verdict, options.json)
    write_shapes(verdict, options)
    if not _is_stdout(options.json):
        print_verdict(
            verdict, console=Console(), hint_step=options.hint, only=options.only,
            whole=options.all, before=before, typed=as_typed(options),
        )  # fmt: skip
    return EXIT_OF_OUTCOME[verdict.outcome]


def _is_stdout(path: Path | None) -> bool:
    return str(path) == "-"


def _kept(lab: Lab) -> Path:
    """Where the last verdict lies, for `--hint`."""
    return workspace_root() / ".roslings" / f"verdict-{lab.name}.json"


def _replace_kept(lab: Lab, verdict: Verdict) -> Verdict | None:
    """Keep this verdict; the one before, or None where there is none that can be read."""
    from roslings.report import BadVerdictFile

    before = None
    with suppress(BadVerdictFile):
        before = _read(_kept(lab))
    _keep(lab, verdict)
    return before


def _read(path: Path) -> Verdict:
    from roslings.report import read_json

    return read_json(path)


def _keep(lab: Lab, verdict: Verdict) -> None:
    """Keep score and verdict; a workspace that cannot be written does not hide the verdict."""
    from roslings.report import CannotWrite, write_json
    from roslings.workspace.progress import record

    if not workspace_root().is_dir():
        return
    try:
        record(verdict)
        write_json(verdict, _kept(lab))
    except (WorkspaceError, CannotWrite) as error:
        print(f"roslings: the score was not kept. {error}", file=sys.stderr)


def watch(options: argparse.Namespace) -> int:
    """Check now, and again at every save, until Ctrl-C."""
    lab = course.lab(options.lab)
    folder = package_of(lab, options.path)
    with suppress(KeyboardInterrupt):
        _watch(lab, folder, options)
    return OK


def _watch(lab: Lab, folder: Path, options: argparse.Namespace) -> None:
    from roslings.checking import ready_again_and_again
    from roslings.workspace.watch import changes

    saves = changes(folder, begin=True)  # begun first: a save during a check is not missed
    with closing(ready_again_and_again(lab)) as each_ready:
        for number, ready in enumerate(each_ready):  # ready first: only the save is waited for
            if number:
                print("\nWatching. Save a file to check again; Ctrl-C ends it.", flush=True)
            saved = next(saves, None)
            if saved is None:
                return
            if saved:
                print(f"\nSaved: {_names(saved, folder)}", flush=True)
            _check_saved(lab, options, ready)


def _check_saved(lab: Lab, options: argparse.Namespace, ready: Ready) -> None:
    """One check; what is wrong with the package now may be right at the next save."""
    from roslings.cli import explain

    try:
        graded = ready.grade(package_of(lab, options.path), time.monotonic_ns())
        _show(graded.verdict, options, _replace_kept(lab, graded.verdict))
    except Exception as error:
        explain(error)


def _names(saved: frozenset[Path], folder: Path) -> str:
    inside = (path for path in saved if path != folder.resolve())
    names = sorted(str(path.relative_to(folder.resolve())) for path in inside)
    return ", ".join(names[:3]) or "the package"


# --- authors of labs ---------------------------------------------------------------------------


def new_lab(options: argparse.Namespace) -> int:
    """Make a small lab that works."""
    from roslings.authoring.new_lab import new_lab as make

    lab = make(options.lab, options.package, options.day)
    print(f"The lab {lab.name!r} is in {_from_here(lab.folder)}.")
    print(f"Its grader is {_from_here(lab.grader)}. Both work as they are; change them.")
    print(f"Then prove it: ./roslings prove {lab.name}")
    return OK


USUALLY_PROVEN = ("packages", "contract")
PROVABLE = (*USUALLY_PROVEN, "generated", "rewritten")


def prove(options: argparse.Namespace) -> int:
    """Prove labs' packages and contracts, and say what is not as it must be."""
    from roslings.authoring.prove import Proof
    from roslings.authoring.telling import told
    from roslings.batch.command import Teller
    from roslings.report import Progress

    names = [name for name in PROVABLE if getattr(options, name)]
    parts = [_proofs_of(name, options) for name in names or USUALLY_PROVEN]
    labs = [course.lab(name) for name in dict.fromkeys(options.labs)]
    try:
        with Progress() as progress:
            lines = [line for part in parts for line in part(labs, Teller(progress), options.jobs)]
    except KeyboardInterrupt:
        if options.generated:
            print("\nWhat is graded is kept. The same command goes on from here.", file=sys.stderr)
        raise
    for text in told(lines, all_of_them=options.all):
        print(text)
    wrong = [line for line in lines if isinstance(line, Proof) and not line.holds]
    if not wrong:
        for lab in labs:
            only = f": its {' and '.join(names)} only" if names else ""
            print(f"The lab {lab.name!r} is proven{only}.")
        return OK
    return INCONCLUSIVE if all(proof.is_open for proof in wrong) else FAILED


def _proofs_of(name: str, options: argparse.Namespace) -> Callable[..., Iterable[Any]]:
    """What proves a part of labs; all that it tells has a `line`. LibCST is only where needed."""
    if name == "generated":
        from roslings.authoring.generated.run import proofs_for

        return proofs_for(options.keep, options.keep_kills, options.so_far)
    if name == "rewritten":
        from roslings.authoring.rewritten import prove_rewritten

        return prove_rewritten
    if name == "contract":
        from roslings.authoring.contract import prove_contract

        return prove_contract
    from roslings.authoring.prove import prove as prove_packages

    return prove_packages


def release(options: argparse.Namespace) -> int:
    """Make the students' edition."""
    from roslings.authoring.release import release as make

    names = make(options.to)
    print(f"The students' edition is in {_from_here(options.to)}: {len(names)} files.")
    print("No solution, no mutant and no hidden check is in it.")
    return OK


def export(options: argparse.Namespace) -> int:
    """Make what an instructor uploads to a grading platform."""
    from roslings.export import export as make

    lab = course.lab(options.lab, options.hidden)
    for line in make(options.system, lab, options.to):
        print(line)
    return OK


# --- the workspace -----------------------------------------------------------------------------


def start(options: argparse.Namespace) -> int:
    """Put a lab's starter into the workspace."""
    from roslings.workspace.student import start as put

    lab = course.lab(options.lab)
    started = put(lab)
    print(f"The starter of {lab.name!r} is in {shown(started.package)} ({started.files} files).")
    print(f"Read the task: {_from_here(lab.task)}")
    print(f"Then check what you built: {program()} check {lab.name}")
    return OK


def _from_here(path: Path) -> str:
    here = Path.cwd()
    return str(path.relative_to(here)) if path.is_relative_to(here) else shown(path)


def diff(options: argparse.Namespace) -> int:
    """Show what changed since the starter."""
    from roslings.report.safe_text import harmless
    from roslings.workspace.student import diff as changes

    lines = changes(course.lab(options.lab))
    for line in lines:
        print(harmless(line.rstrip("\n")))
    if not lines:
        print("Nothing is changed: this is the starter.")
    return OK


def pack(options: argparse.Namespace) -> int:
    """Make the zip to hand in."""
    from roslings.workspace.student import pack as zip_it

    lab = course.lab(options.lab)
    packed = zip_it(lab, options.out, options.path)
    verb = "Replaced" if packed.replaced else "Made"
    print(f"{verb} {shown(packed.path)}: {len(packed.files)} files, {packed.size_bytes:,} bytes.")
    print("Hand in this one file.", flush=True)
    _let_run(lab, options)
    return OK


def _let_run(lab: Lab, options: argparse.Namespace) -> None:
    """Let the nodes run as they will where they are graded; the file is there, whatever comes."""
    from roslings.course.soak import soak_seconds
    from roslings.handing_in import left_running
    from roslings.report import Progress

    if for_s := soak_seconds(lab.card, options.soak):
        try:
            with Progress() as progress:
                lines = left_running(lab, package_of(lab, options.path), for_s, progress.step)
        except KeyboardInterrupt:
            lines = ["Your nodes were not watched to the end. The file is whole."]
        print("\n".join(lines))


def status(options: argparse.Namespace) -> int:
    """Show days and labs done."""
    from roslings.workspace import progress

    labs = progress.status()
    width = max((len(each.lab.name) for each in labs), default=0)
    for day, done in progress.days_done(labs).items():
        print(f"{'done' if done else 'open':5} {day}")
        for each in (each for each in labs if each.lab.outline.day == day):
            print(f"      {each.lab.name:{width}}  {_how_far(each)}")
    return OK


def _how_far(each: LabStatus) -> str:
    if not each.progress.checks:
        return "begun, not yet checked" if each.package else "not begun"
    best = f"best {each.progress.best:g} of 100, last {each.progress.last:g}"
    return f"done ({best})" if each.progress.done else best


def today(options: argparse.Namespace) -> int:
    """Say what is next."""
    from roslings.workspace import progress

    next_step = progress.today()
    if next_step.at is None:
        print(f"All labs are done. See them all: {program()} status")
        return OK
    lab = next_step.at.lab
    print(f"Day {lab.outline.day}: {lab.outline.title}  ({_how_far(next_step.at)})")
    verb = "start" if next_step.step is progress.Step.START else "check"
    print(f"Next: {program()} {verb} {lab.name}")
    print(f"The task: {_from_here(lab.task)}")
    print(f"All commands: {program()} --help")
    return OK


# --- the graph ---------------------------------------------------------------------------------


def graph(options: argparse.Namespace) -> int:
    """Show the running graph, or save a picture of it."""
    from roslings.report import graph_text
    from roslings.ros2.rqt_graph import seen_graph
    from roslings.ros2.surroundings import prepare

    files = _pictures_wanted(options)
    there = [file for file in files if file.exists() and not options.force]
    if there:
        print(f"roslings: {there[0]} is there already. Nothing was changed.", file=sys.stderr)
        print("To replace it, add --force.", file=sys.stderr)
        return WRONG_USE
    prepare()
    seen = seen_graph()  # complete: a fixed wait misses nodes, by luck, that run all the time
    print(graph_text(seen, show_hidden=options.all))
    if not seen.nodes and options.lab:
        return _nothing_to_draw()
    for file in files:
        if not _saved(seen, file, options):
            return WRONG_USE
    return OK if seen.nodes else FAILED


def _pictures_wanted(options: argparse.Namespace) -> list[Path]:
    """The file that was named, or those that a lab's card wants in the package."""
    if not options.lab:
        return [options.save] if options.save else []
    lab = course.lab(options.lab)
    package = package_of(lab, options.path)
    if not lab.card.pictures:
        print(f"The lab {lab.name!r} wants no picture.")
    return [package / picture.path for picture in lab.card.pictures]


def _nothing_to_draw() -> int:
    print("\nNothing was saved: no node runs. Start your nodes, each in a terminal of its own,")
    print("then type the same command once more.")
    return FAILED


def _saved(seen: GraphSeen, file: Path, options: argparse.Namespace) -> bool:
    """Draw the picture; its folder is made where it is missing."""
    from roslings.report import draw_graph
    from roslings.report.graph_picture import NotAPng

    try:
        draw_graph(seen, file, show_hidden=options.all, overwrite=options.force)
    except NotAPng as error:
        print(f"roslings: {error}", file=sys.stderr)
        return False
    print(f"\nSaved {shown(file) if options.lab else file}")
    return True


# --- the notebooks -----------------------------------------------------------------------------


def lab(options: argparse.Namespace) -> int:
    """Open the day's lesson in JupyterLab, until Ctrl-C."""
    from roslings.jupyter.choosing import place_for
    from roslings.jupyter.copies import Copies
    from roslings.jupyter.server import open_lab
    from roslings.lessons import read_lessons

    days = read_lessons(course.root()).days
    copies = Copies(course.root(), workspace_root())
    place = place_for(options.day, days, copies, options.port, not options.no_browser)
    place = replace(place, ip=options.ip)
    for told in copies.copy_all(days):
        print(told)
    return open_lab(place)


# --- the rover ---------------------------------------------------------------------------------


def rover(options: argparse.Namespace) -> int:
    """Run the rover and its map until Ctrl-C."""
    from roslings.devices.rover.running import run
    from roslings.ros2.surroundings import check_middleware, domain_id, prepare

    prepare()
    domain_id()
    check_middleware()
    run(options.view, options.save, options.seed)
    return OK


def board(options: argparse.Namespace) -> int:
    """Run the rover's board on a serial port until Ctrl-C."""
    from roslings.devices.board.live import run, usual_port

    run(options.port or usual_port(), options.sketch)
    return OK


def camera(options: argparse.Namespace) -> int:
    """Run the rover's camera until Ctrl-C."""
    from roslings.devices.camera.live import run, usual_path

    run(options.device or usual_path(), options.hue, options.noise)
    return OK


# --- the site ----------------------------------------------------------------------------------


def site(options: argparse.Namespace) -> int:
    """Build the site. Sphinx and its settings live beside the pages, not in the engine."""
    words = [f"--{name.replace('_', '-')}" for name in SITE_WORDS if getattr(options, name)]
    place = ["--out", str(options.out)] if options.out else []
    builder = course.root() / "site" / "build.py"
    return subprocess.run([sys.executable, str(builder), *words, *place], check=False).returncode


# --- the tests ---------------------------------------------------------------------------------


def test(options: argparse.Namespace) -> int:
    """Run the tests of roslings; what follows `test` goes to pytest."""
    return run_pytest([word for word in options.rest if word != "--"])


def run_pytest(rest: Sequence[str]) -> int:
    """Run pytest in the course's folder, on both cores."""
    command = [sys.executable, "-m", "pytest", *rest]
    return subprocess.run(command, cwd=course.root(), check=False).returncode
