"""SP060: the setup.py of an ament_python package does not use catkin."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule

_MANIFEST = (
    "<package format='3'><name>talker</name><export><build_type>{}</build_type></export>"
    "</package>\n"
)
_SETUP = (
    "from setuptools import setup\nfrom catkin_pkg.python_setup import generate_distutils_setup\n\n"
    "setup(**generate_distutils_setup(packages=['talker']))\n"
)


class SetupOfCatkin(Rule):
    """An ament_python package has a setup.py for catkin.

    **Why.** colcon stops with ``TypeError: 'NoneType' object is not iterable``: the arguments that
    catkin generates contain no ``data_files`` and no entry points.

    **Fix.** Call ``setup()`` with ``name``, ``version``, ``packages``, ``data_files`` and
    ``entry_points``; ``ros2-scaffold new`` writes one.

    **Source.** ``catkin_pkg/python_setup.py``; ROS 2 documentation, "Migrating a Python package".
    """

    code = "SP060"
    name = "setup-of-catkin"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("for catkin", {"package.xml": _MANIFEST.format("ament_cmake"), "setup.py": _SETUP}),
        Example(
            "for both",
            {
                "package.xml": _MANIFEST.format("ament_python"),
                "setup.py": "import os\n\nif os.environ['ROS_VERSION'] == '1':\n"
                "    from catkin_pkg.python_setup import generate_distutils_setup\n",
            },
        ),
        Example(
            "for ament_python",
            {"package.xml": _MANIFEST.format("ament_python"), "setup.py": _SETUP},
            "setup.py:2:1: generate_distutils_setup() is for catkin: colcon stops; call setup() "
            "with data_files and entry_points",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type != "ament_python":
            return
        for import_ in package.setup_py.module.imports:
            if import_.module == "catkin_pkg.python_setup" and import_.top_level:
                message = (
                    "generate_distutils_setup() is for catkin: colcon stops; call setup() with "
                    "data_files and entry_points"
                )
                yield self.report(import_, message)
