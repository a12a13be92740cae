"""Tell colcon what to install and how the programs are called."""

from setuptools import setup  # type: ignore[import-untyped,unused-ignore]

package_name = "greeter"

setup(
    name=package_name,
    version="0.0.1",
    packages=[package_name],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/" + package_name]),
        ("share/" + package_name, ["package.xml"]),
        ("share/" + package_name + "/launch", ["launch/greet.launch.xml"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    maintainer="A student",
    maintainer_email="student@example.com",
    description="A small package that greets, for the break-it exercises",
    license="Apache-2.0",
    entry_points={
        "console_scripts": [
            "hello = greeter.hello:main",
        ],
    },
)
