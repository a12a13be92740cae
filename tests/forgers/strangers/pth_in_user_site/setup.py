"""Plants the same .pth file while the package is built; chatter/plant.py does it."""

import runpy
import sys
from contextlib import suppress
from pathlib import Path

from setuptools import find_packages, setup

package_name = "chatter"


def say(text):
    """Print what was reached; colcon reads the output of a dry run, so be silent there."""
    if "--dry-run" not in sys.argv:
        print("GOT", text, flush=True)


with suppress(Exception):
    code = Path(__file__).resolve().parent / package_name
    runpy.run_path(str(code / "plant.py"))["plant"]((code / "helper.py").read_text(), say)

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
    maintainer="A learner",
    maintainer_email="learner@example.com",
    description="A talker and a listener on the topic /chatter.",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "talker = chatter.talker:main",
            "listener = chatter.listener:main",
        ],
    },
)
