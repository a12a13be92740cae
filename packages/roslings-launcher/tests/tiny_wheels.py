"""Small, real wheels, made by the tests themselves."""

from __future__ import annotations

import base64
import hashlib
import zipfile
from collections.abc import Mapping, Sequence
from importlib.metadata import Distribution, distribution
from pathlib import Path


def make_wheel(
    folder: Path,
    name: str,
    version: str,
    files: Mapping[str, str | bytes] | None = None,
    requires: Sequence[str] = (),
    scripts: Mapping[str, str] | None = None,
) -> Path:
    """A wheel of `name` in `folder`: by default one module that holds its version."""
    module = name.replace("-", "_")
    content = dict(files or {f"{module}.py": f"VERSION = {version!r}\n"})
    info = f"{module}-{version}.dist-info"
    content[f"{info}/METADATA"] = _metadata(name, version, requires)
    content[f"{info}/WHEEL"] = (
        "Wheel-Version: 1.0\nGenerator: tests\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
    )
    if scripts:
        lines = "".join(f"{script} = {target}\n" for script, target in scripts.items())
        content[f"{info}/entry_points.txt"] = f"[console_scripts]\n{lines}"
    return _write(folder / f"{module}-{version}-py3-none-any.whl", info, content)


def wheel_of_installed(folder: Path, name: str) -> Path:
    """The wheel that an installed pure Python package came from, put together again.

    Raises:
        importlib.metadata.PackageNotFoundError: it is not installed here.
    """
    found = distribution(name)
    info = f"{name}-{found.version}.dist-info"
    wheel = folder / f"{name}-{found.version}-py3-none-any.whl"
    return _write(wheel, info, _files(found))


def _files(found: Distribution) -> dict[str, str | bytes]:
    left_out = ("RECORD", "INSTALLER", "REQUESTED", "direct_url.json")
    return {
        str(path): Path(str(path.locate())).read_bytes()
        for path in found.files or ()
        if path.suffix != ".pyc" and path.name not in left_out and ".." not in path.parts
    }


def _metadata(name: str, version: str, requires: Sequence[str]) -> str:
    needs = "".join(f"Requires-Dist: {need}\n" for need in requires)
    return f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n{needs}"


def _write(wheel: Path, info: str, content: Mapping[str, str | bytes]) -> Path:
    rows = []
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_STORED) as archive:
        for path, text in content.items():
            body = text.encode() if isinstance(text, str) else text
            archive.writestr(path, body)
            digest = base64.urlsafe_b64encode(hashlib.sha256(body).digest()).rstrip(b"=")
            rows.append(f"{path},sha256={digest.decode()},{len(body)}\n")
        archive.writestr(f"{info}/RECORD", "".join(rows) + f"{info}/RECORD,,\n")
    return wheel
