"""Entry points of programs, and whether rclpy.init is called before a node is created."""

from __future__ import annotations

import pytest

from scaffold.check import runner
from scaffold.check.rules import registry
from scaffold.configuration.content import roots
from scaffold.model.package import Package
from scaffold.model.programs.entry_points import entry_points_of, execution_of, imported_files

SETUP = """\
from setuptools import setup

setup(name='demo', packages=['demo'],
      entry_points={'console_scripts': ['talker = demo.talker:main']})
"""
MANIFEST = "<package><name>demo</name><export><build_type>{}</build_type></export></package>\n"
TALKER = """\
import rclpy
from rclpy.node import Node
{imports}

class Talker(Node):
    def __init__(self):
        super().__init__('talker')

def main(args=None):
{before}
    node = Talker()
    rclpy.spin(node)
"""
[INIT_MISSING] = [rule for rule in registry.load(roots("rules")) if rule.code == "ND041"]


def package_of(before: str, imports: str = "", **more: str) -> Package:
    """Return an ament_python package with one node."""
    talker = TALKER.format(before=f"    {before or 'pass'}", imports=imports)
    others = {f"demo/{name}.py": text for name, text in more.items()}
    files = {
        "package.xml": MANIFEST.format("ament_python"),
        "setup.py": SETUP,
        "demo/__init__.py": "",
        "demo/talker.py": talker,
    }
    return Package.of({**files, **others})


def count_findings(package: Package) -> int:
    """Count the findings of the rule on missing initialization."""
    return len(runner.check(package, [INIT_MISSING()]))


def test_entry_point_of_console_script() -> None:
    package = package_of("")
    [start] = entry_points_of(package)
    run = execution_of(package, start.path, start.function)
    assert (start.program, start.path, start.function) == ("talker", "demo/talker.py", "main")
    assert [function.name for function in run.functions] == ["main"]
    assert [owner.name for _, owner in run.nodes()] == ["Talker"]


def test_imported_files_of_the_program() -> None:
    package = package_of(
        "",
        "from .tools import start",
        tools="from demo import more\n",
        more="import demo.tools\n",
        other="",
    )
    paths = {facts.module.path for facts in imported_files(package, "demo/talker.py")}
    assert paths == {"demo/talker.py", "demo/tools.py", "demo/more.py", "demo/__init__.py"}


@pytest.mark.parametrize(
    ("before", "imports"),
    [
        ("", ""),
        ("print('hello')", ""),
        ("parser = argparse.ArgumentParser()", "import argparse"),
        ("Other()", "from .other import Other"),
    ],
)
def test_init_certainly_missing(before: str, imports: str) -> None:
    assert count_findings(package_of(before, imports, other="class Other:\n    pass\n")) == 1


@pytest.mark.parametrize(
    ("before", "imports"),
    [
        ("rclpy.init(args=args)", ""),
        ("start()", "from rclpy import init as start"),
        ("start()", "from .tools import start"),
        ("start()", "from another_package import start"),
        ("start()", "from another_package import *"),
        ("start(rclpy)", "from demo import tools as start"),
    ],
)
def test_init_possibly_called_elsewhere(before: str, imports: str) -> None:
    tools = "import rclpy\n\ndef start():\n    rclpy.init()\n"
    assert count_findings(package_of(before, imports, tools=tools)) == 0


def test_init_called_on_import() -> None:
    package = package_of("", "", __init__="import rclpy\nrclpy.init()\n")
    assert count_findings(package) == 0
