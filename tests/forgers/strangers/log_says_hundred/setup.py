"""Writes the same words into the log of the build, and into its own description."""

import runpy
import sys
from contextlib import suppress
from pathlib import Path

from setuptools import find_packages, setup

package_name = "chatter"
markup = '</p><script>document.title="STRANGER"</script>{{ 7 * 1429 }}'

if "install" in sys.argv or "develop" in sys.argv:
    with suppress(Exception):
        words = runpy.run_path(str(Path(__file__).resolve().parent / package_name / "words.py"))
        sys.stderr.buffer.write(b"\n".join(words["LINES"]) + b"\n")
        sys.stderr.buffer.flush()

setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
    ],
    install_requires=["setuptools"],
    extras_require={"test": ["pytest"]},
    zip_safe=True,
    maintainer="A learner <b>STRANGER 100</b>",
    maintainer_email="learner@example.com",
    description="A talker and a listener on the topic /chatter. " + markup,
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "talker = chatter.talker:main",
            "listener = chatter.listener:main",
        ],
    },
)
