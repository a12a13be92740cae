"""The examination as JSON, in the shape of `schema.json` beside this file."""

from __future__ import annotations

from typing import Any

from ros_doctor.examine import Examination, ExaminedCheck
from ros_doctor.finding import Status
from ros_doctor.ros import find_ros
from ros_doctor.surroundings import container, in_short, pi_model, release, wsl

SCHEMA = 1  # raised when a field changes its meaning or goes away


def document(examination: Examination) -> dict[str, Any]:
    """Return the examination as plain values, worst finding first."""
    return {
        "schema": SCHEMA,
        "outcome": examination.worst.value,
        "summary": {status.value: examination.count(status) for status in Status},
        "machine": _machine(examination),
        "workspace": str(examination.machine.workspace),
        "checks": [_check(one) for one in examination.worst_first()],
        "seconds": round(examination.seconds, 3),
    }


def _machine(examination: Examination) -> dict[str, Any]:
    machine = examination.machine
    ros = find_ros(machine)
    return {
        "name": in_short(machine),
        "system": machine.system,
        "release": release(machine).name,
        "architecture": machine.architecture,
        "python": ".".join(str(part) for part in machine.interpreter.version),
        "container": container(machine),
        "wsl": wsl(machine),
        "pi": pi_model(machine),
        "ros": ros.kind if ros else "",
        "ros_ready": bool(ros and ros.ready),
    }


def _check(result: ExaminedCheck) -> dict[str, Any]:
    check, finding = result.check, result.finding
    return {
        "id": check.id,
        "theme": check.theme,
        "title": check.told("title"),
        "status": finding.status.value,
        "found": finding.found,
        "looks_at": check.told("looks_at"),
        "symptom": check.told("symptom"),
        "mend": [{"text": step.text, "command": step.command} for step in finding.mend],
        "lesson": check.lesson,
        "seconds": round(result.seconds, 4),
    }
