"""The same work on a Dask cluster: each submission travels, a small result comes back.

A worker looks at itself first: its sandbox, its versions. A worker that dies loses nothing: Dask
gives its task to another one, and what nobody could grade is tried again at the end.
"""

from __future__ import annotations

import io
import time
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import roslings
from roslings import course
from roslings.arena import choose_isolation
from roslings.experiment.run_folder import LOCK, run_folder
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.sources import files
from roslings_class.errors import BatchError
from roslings_class.result import GradingOrder, GradingResult, broken
from roslings_class.version import version_of
from roslings_class.worker_pool import EndedGrading, GradingLimits, worker_pool

CONNECT_WITHIN_S = 20.0
FIT = ""


class NoCluster(BatchError):
    """There is no scheduler at the address, or it has no worker."""

    def __init__(self, address: str, problem: str) -> None:
        super().__init__(
            f"{address}: {problem}",
            "Start one: ./roslings cluster scheduler\n"
            f"and on each machine: ./roslings cluster worker {address}",
        )


class UnfitWorkers(BatchError):
    """A worker has no sandbox, or another version of roslings or of the lab."""

    def __init__(self, told: dict[str, str]) -> None:
        lines = "\n".join(f"  {worker}: {reason}" for worker, reason in sorted(told.items()))
        super().__init__(
            f"These workers cannot grade this lab:\n{lines}",
            "Give all machines the same clone of roslings, then start their workers again.",
        )


@dataclass(frozen=True)
class Parcel:
    """A submission on its way: all that a worker needs, without a shared disk."""

    order: dict[str, Any]
    name: str
    content: bytes
    is_folder: bool
    """It was a folder, and travels as a zip file."""
    hidden: bytes | None
    version: str
    trust: bool
    limits: GradingLimits


# --- on the worker -----------------------------------------------------------------------------


def fitness(lab: str, version: str, hidden: bytes | None, trust: bool) -> str:
    """Why this machine must not grade the lab; empty where it may."""
    if not trust and (lack := choose_isolation().lack):
        return f"no sandbox: {lack.reason}"
    try:
        with run_folder() as room:
            mine = version_of(course.lab(lab, _unpacked_hidden(hidden, room)))
    except course.CourseError as error:
        return str(error)
    if mine != version:
        return f"another version of the lab or of roslings ({roslings.__version__})"
    return FIT


def grade_parcel(parcel: Parcel) -> tuple[str, bytes | None]:
    """Grade what is in the parcel, in a process of its own; the result as JSON, and evidence."""
    order = GradingOrder.model_validate(parcel.order)
    if reason := fitness(order.lab, parcel.version, parcel.hidden, parcel.trust):
        return broken(order, reason).model_dump_json(by_alias=True), None
    with run_folder() as scratch, worker_pool(scratch / LOCK, parcel.limits) as workers:
        workers.start(_at_home(order, parcel, scratch))
        while True:
            for ended in workers.wait(5.0):
                return ended.result.model_dump_json(by_alias=True), ended.evidence


def _at_home(order: GradingOrder, parcel: Parcel, scratch: Path) -> GradingOrder:
    """The order with the paths of this machine."""
    arrived = scratch / "arrived"
    arrived.mkdir()
    path = arrived / parcel.name
    if parcel.is_folder:
        with zipfile.ZipFile(io.BytesIO(parcel.content)) as archive:
            archive.extractall(path)
    else:
        path.write_bytes(parcel.content)
    own = {
        "path": path,
        "room": scratch / "room",
        "builds": None,
        "hidden": _unpacked_hidden(parcel.hidden, scratch),
    }
    return order.model_copy(update=own)


def _unpacked_hidden(content: bytes | None, room: Path) -> Path | None:
    if content is None:
        return None
    path = room / "hidden_checks.py"
    path.write_bytes(content)
    return path


# --- in the command ----------------------------------------------------------------------------


@dataclass
class DaskPool:
    """Those that are graded on the cluster now; used as the worker pool of this machine is."""

    client: Any
    version: str
    trust: bool
    limits: GradingLimits
    workers: dict[Any, tuple[GradingOrder, float]] = field(default_factory=dict)
    """Dask's future to its order, and when it began."""
    refused: list[EndedGrading] = field(default_factory=list)

    @property
    def soaking(self) -> int:
        """None that is known here: each has a thread of the cluster until its end."""
        return 0

    def start(self, order: GradingOrder) -> None:
        """Send one more."""
        try:
            parcel = _packed(order, self.version, self.trust, self.limits)
        except (WorkspaceError, OSError) as error:
            self.refused.append(EndedGrading(order, _cannot_travel(order, error), None))
            return
        future = self.client.submit(grade_parcel, parcel, pure=False)
        self.workers[future] = order, time.monotonic()

    def wait(self, most_s: float) -> Iterator[EndedGrading]:
        """Those that end within `most_s`, as soon as there is one."""
        from distributed import TimeoutError, wait

        while self.refused:
            yield self.refused.pop()
        if not self.workers:
            return
        try:
            done = wait(list(self.workers), timeout=most_s, return_when="FIRST_COMPLETED").done
        except TimeoutError:
            return
        for future in done:
            order, began_s = self.workers.pop(future)
            yield _ended(future, order, time.monotonic() - began_s)

    def threads(self) -> int:
        """How many the cluster grades at once now; at least one."""
        return max(1, sum(map(int, self.client.nthreads().values())))


def _packed(order: GradingOrder, version: str, trust: bool, limits: GradingLimits) -> Parcel:
    path = order.path
    return Parcel(
        order.model_dump(mode="json"),
        path.name,
        _zipped(path) if path.is_dir() else path.read_bytes(),
        path.is_dir(),
        order.hidden.read_bytes() if order.hidden else None,
        version,
        trust,
        limits,
    )


def _zipped(folder: Path) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in files(folder).items():
            archive.write(path, name)
    return content.getvalue()


def _cannot_travel(order: GradingOrder, error: Exception) -> GradingResult:
    words = {
        "submission": order.submission,
        "digest": order.digest,
        "attempt": order.attempt,
        "state": "refused",
        "reason": getattr(error, "problem", str(error)),
        "next_step": getattr(error, "next_step", ""),
    }
    return GradingResult.model_validate(words)


def _ended(future: Any, order: GradingOrder, seconds: float) -> EndedGrading:
    """The worker's answer; a task that ended every worker it came to is nobody's zero."""
    if future.status != "finished":
        reason = f"No worker could grade it: {future.exception()}"
        return EndedGrading(order, broken(order, reason, seconds), None)
    text, evidence = future.result()
    return EndedGrading(order, GradingResult.model_validate_json(text), evidence)


@contextmanager
def dask_pool(
    address: str, lab: course.Lab, trust: bool, limits: GradingLimits
) -> Iterator[DaskPool]:
    """A pool of workers on the cluster at `address`. Raises NoCluster and UnfitWorkers."""
    from distributed import Client

    try:
        client = Client(address, timeout=CONNECT_WITHIN_S, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        raise NoCluster(address, f"no scheduler answers ({type(error).__name__}).") from error
    with client, client.as_current():
        hidden = lab.hidden.read_bytes() if lab.hidden else None
        told = client.run(fitness, lab.name, version_of(lab), hidden, trust, on_error="return")
        if not told:
            raise NoCluster(address, "the scheduler has no worker.")
        if unfit := {worker: str(reason) for worker, reason in told.items() if reason != FIT}:
            raise UnfitWorkers(unfit)
        made = DaskPool(client, version_of(lab), trust, limits)
        try:
            yield made
        finally:
            client.cancel(list(made.workers), force=True)
