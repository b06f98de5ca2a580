"""The style findings for each distribution, compared with the linters that it ships.

Each set of linters is installed into an environment of its own, with the Python of the distribution
or the nearest that this machine has.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from importlib.util import find_spec
from pathlib import Path

import pytest

from scaffold import distributions
from scaffold.ament import StyleCheck, linters
from scaffold.ament.pep257.codes import AMENT as PEP257_CODES
from scaffold.distributions import ORDER, named
from scaffold.model.package import Package
from tests.ament import style_cases
from tests.ament.profile_cases import BY_FILE
from tests.oracles import system_environment

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]

GROUPS = (
    "WHITESPACE_AND_STATEMENTS",
    "LINES_AND_NOQA",
    "CONTINUATION_LINES",
    "NAMES",
    "IMPORTS",
    "BUILTINS",
    "DEFINITIONS",
)
Found = set[tuple[str, int, str]]


def interpreter(wanted: tuple[int, int]) -> str:
    """Return a Python of a version, or of the nearest one with the same f-string tokens."""
    known = [wanted, (3, 13), (3, 12)] if wanted >= (3, 12) else [wanted]
    for major, minor in known:
        for path in [*_of_pyenv(f"{major}.{minor}"), f"python{major}.{minor}"]:
            if shutil.which(path) and _runs(path):
                return path
    pytest.skip(f"no Python {wanted[0]}.{wanted[1]} to run its linters with")


def _runs(path: str) -> bool:
    """Return whether a Python starts, unlike a shim of pyenv for a missing version."""
    done = subprocess.run([path, "-c", ""], env=system_environment(), check=False)
    return done.returncode == 0


def _of_pyenv(version: str) -> list[str]:
    root = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    return [str(path) for path in root.glob(f"versions/{version}.*/bin/python")]


@pytest.fixture(scope="module", params=ORDER)
def oracle(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Oracle:
    """Return the linters of a distribution."""
    return Oracle(request.param, tmp_path_factory.mktemp("linters"))


class Oracle:
    """The linters of a distribution in their own environment."""

    def __init__(self, name: str, directory: Path) -> None:
        self.name = name
        self.distribution = named(name)
        python = interpreter(self.distribution.python)
        environment = system_environment()
        subprocess.run([python, "-m", "venv", str(directory / "venv")], env=environment, check=True)
        self._python = str(directory / "venv" / "bin" / "python")
        wanted = [f"{name}=={version}" for name, version in self._versions().items()]
        # pkg_resources, which old plugins import; and the interface that flake8 4 reads them by.
        wanted += ["setuptools<60"]
        if self._versions()["flake8"].startswith("4."):
            wanted += ["importlib-metadata<5"]
        install = [self._python, "-m", "pip", "install", "--quiet", *wanted]
        subprocess.run(install, env=environment, check=True)
        self._configuration = directory / "ament_flake8.ini"
        spec = find_spec("ament_flake8")
        assert spec is not None
        assert spec.origin is not None
        own = Path(spec.origin).parent / "configuration" / "ament_flake8.ini"
        shutil.copy(own, self._configuration)

    def _versions(self) -> dict[str, str]:
        return {str(name): str(value) for name, value in self.distribution.fact("linters").items()}

    def run(self, directory: Path) -> Found:
        """Return the findings of the linters; files that crash flake8 are omitted."""
        paths = [str(path.relative_to(directory)) for path in sorted(directory.rglob("*.py"))]
        return self._flake8(directory, paths) | self._pydocstyle(directory)

    def _flake8(self, directory: Path, paths: list[str]) -> Found:
        done = self._call(
            directory, "flake8", "--jobs=1", f"--config={self._configuration}", *paths
        )
        if "Traceback" in done.stderr:
            if len(paths) == 1:
                (directory / paths[0]).unlink()
                return set()
            half = len(paths) // 2
            return self._flake8(directory, paths[:half]) | self._flake8(directory, paths[half:])
        result = re.findall(r"(?m)^(\S+?):(\d+):\d+: ([A-Z]+\d+)", done.stdout)
        return {(path, int(line), code) for path, line, code in result}

    def _pydocstyle(self, directory: Path) -> Found:
        select = f"--select={','.join(sorted(PEP257_CODES))}"
        words = [select, "--match=.*\\.py"]
        with distributions.targeting(self.distribution):
            if linters.of_target().since("pydocstyle", 6, 2):
                words.append("--property-decorators=")  # ament_pep257 names none
        done = self._call(directory, "pydocstyle", *words, ".")
        result = re.findall(r"(?m)^\./(\S+?):(\d+) .*\n\s+(D\d+):", done.stdout)
        return {(path, int(line), code) for path, line, code in result}

    def _call(self, directory: Path, module: str, *words: str) -> subprocess.CompletedProcess[str]:
        # Not with -m: modules of the cases, such as logging.py, would hide those of Python.
        command = [str(Path(self._python).with_name(module)), *words]
        environment = {**system_environment(), "PYTHONWARNINGS": "ignore"}
        return subprocess.run(
            command, cwd=directory, env=environment, capture_output=True, text=True, check=False
        )


def ours(oracle: Oracle, directory: Path) -> Found:
    """Return our findings for the distribution."""
    with distributions.targeting(oracle.distribution):
        package = Package.at(directory)
        findings = StyleCheck([package]).diagnostics(package)
    return {(item.location.path, item.location.line, item.code) for item in findings}


def differences(oracle: Oracle, directory: Path) -> dict[str, tuple[Found, Found]]:
    """Return the findings of only one side, by the text of the file."""
    real, own = oracle.run(directory), ours(oracle, directory)
    paths = {path for path, _, _ in real ^ own if (directory / path).exists()}
    return {
        (directory / path).read_text(): (
            {item for item in real - own if item[0] == path},
            {item for item in own - real if item[0] == path},
        )
        for path in paths
    }


@pytest.mark.parametrize("group", GROUPS)
def test_same_findings(oracle: Oracle, tmp_path: Path, group: str) -> None:
    for at, case in enumerate(getattr(style_cases, group)):
        (tmp_path / f"case_{at:04}.py").write_bytes(case.encode())
    assert differences(oracle, tmp_path) == {}


def test_same_findings_where_the_distributions_differ(oracle: Oracle, tmp_path: Path) -> None:
    for path, text in BY_FILE.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    assert differences(oracle, tmp_path) == {}
