"""Variables that hold a condition: versions, features, and successful imports."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main

_HEAD = """\
from importlib.metadata import version
import numpy as np
from rclpy.logging import get_logger
L = get_logger('talker')
"""
_TRIED = "try:\n    from rclpy.{}\n    NEW = True\nexcept ImportError:\n{}    NEW = False\n"
_NEW = _TRIED.format("endpoint_info import Info", "")
_BOTH = _TRIED.format("endpoint_info import Info", "    from rclpy.topic_endpoint_info import X\n")
_WARN = "L.warn('x')\n"
_GUARDS = {
    "a version of a package": "NEW = np.__version__ >= '2'\nA = 0 if NEW else np.NaN\n",
    "its first number": (
        "MAJOR = int(np.__version__.split('.')[0])\nA = 0 if MAJOR >= 2 else np.NaN\n"
    ),
    "a class for versions": (
        "NEW = np.lib.NumpyVersion(np.__version__) >= '2.0.0'\nFLOAT = 0 if NEW else np.float_\n"
    ),
    "two names": (
        "V = tuple(int(part) for part in version('rclpy').split('.'))\nOLD = V < (10, 0, 0)\n"
        f"if OLD:\n    {_WARN}"
    ),
    "a local name": (
        "def talk():\n    new = np.__version__ >= '2'\n    if not new:\n        print(np.NaN)\n"
    ),
    "a return": "NEW = np.__version__ >= '2'\ndef f():\n    if NEW: return\n    return np.NaN\n",
    "a feature of the package": "NEW = hasattr(np, 'trapezoid')\nA = 0 if NEW else np.NaN\n",
    "an attribute of self": (
        "class A:\n    def __init__(self):\n        self.new: bool = np.__version__ >= '2'\n"
        "    def f(self):\n        if not self.new: print(np.NaN)\n"
    ),
    "an attribute of the class": (
        "class A:\n    NEW = np.__version__ >= '2'\n    def f(self):\n"
        "        if not self.NEW: print(np.NaN)\ndef f():\n    if not A.NEW: print(np.NaN)\n"
    ),
    "a function": (
        "NEW = np.__version__ >= '2'\ndef is_new():\n    return NEW\n"
        "if not is_new(): print(np.NaN)\n"
    ),
    "a constant that a condition sets": (
        "NEW = False\nif np.__version__ >= '2':\n    NEW = True\nif not NEW: print(np.NaN)\n"
    ),
    "after a failed import": f"{_NEW}if not NEW:\n    {_WARN}",
    "after a failed import, and more": f"{_NEW}if x and NEW is False:\n    {_WARN}",
    "before the import": f"NEW = False\ntry:\n    from rclpy.a import b\n    NEW = True\n"
    f"except ImportError:\n    pass\nif not NEW:\n    {_WARN}",
    "a module that is not there": (
        "try:\n    from rclpy import a\nexcept ImportError:\n    a = None\n"
        f"def f():\n    if a is not None:\n        return\n    {_WARN}"
    ),
    "an import with another one": f"{_BOTH}if NEW:\n    {_WARN}",
    "a handler of any error": "try:\n    L.warn('x')\nexcept Exception:\n    L.warning('x')\n",
}
_OTHERS = {
    "a feature of something else": f"NEW = hasattr(L, 'port')\nif not NEW:\n    {_WARN}",
    "a name of an answer": f"V = np.__version__\ndone = f(V)\nif g(done):\n    {_WARN}",
    "names of each other": f"a = b or c\nb = a or c\nif a:\n    {_WARN}",
    "after an import": f"{_NEW}if NEW:\n    {_WARN}",
    "after an import, perhaps": f"{_NEW}if x or not NEW:\n    {_WARN}",
    "an import of another package": (
        "try:\n    import torch\n    NEW = True\nexcept ImportError:\n    NEW = False\n"
        f"if not NEW:\n    {_WARN}"
    ),
    "a handler that logs": "try:\n    L.warn('x')\nexcept Exception:\n    L.error('no x')\n",
    "a handler that ends": "try:\n    L.warn()\nexcept Exception:\n    L.close()\n",
    "a package that is there": (
        "try:\n    import rclpy\nexcept ImportError:\n    rclpy = None\n"
        f"if rclpy is not None:\n    {_WARN}"
    ),
}


def reported(capsys: pytest.CaptureFixture[str], package: Path, code: str, *more: str) -> list[str]:
    """Return the codes of findings about names removed in Lyrical."""
    (package / "package.xml").write_text("<package><name>talker</name></package>\n")
    (package / "talker.py").write_text(_HEAD + code)
    options = ("--distro", "lyrical", "--format", "json", "--select", "IM050", *more)
    main(["check", str(package), *options])
    return [item["code"] for item in json.loads(capsys.readouterr().out)["diagnostics"]]


@pytest.mark.parametrize("name", _GUARDS)
def test_variable_with_a_condition_is_a_guard(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    assert reported(capsys, tmp_path, _GUARDS[name], "--fix") == []
    assert (tmp_path / "talker.py").read_text() == _HEAD + _GUARDS[name]


@pytest.mark.parametrize("name", _OTHERS)
def test_other_variable_is_no_guard(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    assert reported(capsys, tmp_path, _OTHERS[name]) == ["IM050"]
