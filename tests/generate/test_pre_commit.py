"""The configuration that the extra `pre_commit` writes, and our own hook, in real repositories."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold.cli.main import main
from tests import PATIENCE
from tests.oracles import REQUIRE_ALL

ROOT = Path(__file__).resolve().parents[2]
PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")
CONFIG = ".pre-commit-config.yaml"
FINDING = "imports 'std_msgs', which no dependency in package.xml provides"


class Repository:
    """A real git repository, with commits that run pre-commit."""

    def __init__(self, top: Path, variables: Mapping[str, str]) -> None:
        self.top = top
        self._variables = variables
        top.mkdir(exist_ok=True)
        self.run("git", "init", "-q")

    def run(self, *command: str, code: int | None = 0) -> str:
        """Run a command at the top; return all that it prints."""
        done = subprocess.run(
            command,
            cwd=self.top,
            env=self._variables,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=PATIENCE,
            check=False,
        )
        assert code is None or done.returncode == code, done.stdout
        return done.stdout

    def commit(self, *, code: int = 0) -> str:
        """Commit all that there is; return what git and the hooks print."""
        self.run("git", "add", "--all")
        return self.run("git", "commit", "-m", "work", code=code)


@pytest.fixture
def variables(tmp_path: Path) -> dict[str, str]:
    """An environment with the command, with no configuration of the user, and without an index."""
    identity = {
        f"GIT_{role}_{what}": value
        for role in ("AUTHOR", "COMMITTER")
        for what, value in (("NAME", "Ada"), ("EMAIL", "ada@example.com"))
    }
    return {
        **identity,
        "PATH": os.pathsep.join([os.path.join(sys.prefix, "bin"), os.environ["PATH"]]),
        "HOME": str(tmp_path / "home"),
        "PRE_COMMIT_HOME": str(tmp_path / "pre-commit"),
        "GIT_CONFIG_NOSYSTEM": "1",
        "PIP_NO_INDEX": "1",
        "PIP_CONFIG_FILE": os.devnull,
    }


def make(place: Path, *words: str) -> Path:
    """Make a package that pre-commit checks."""
    command = ["new", "talker", *PERSON, "--extras", "pre_commit", *words]
    assert main([*command, "--destination-directory", str(place)]) == 0
    return place / "talker"


def break_(package: Path) -> str:
    """Take out a dependency; return the manifest as it was."""
    manifest = package / "package.xml"
    text = manifest.read_text()
    lines = [line for line in text.splitlines(keepends=True) if "std_msgs" not in line]
    manifest.write_text("".join(lines))
    return text


def test_a_commit_with_a_fault_fails_and_one_without_passes(
    tmp_path: Path, variables: dict[str, str]
) -> None:
    package = make(tmp_path)
    repository = Repository(package, variables)
    repository.run("pre-commit", "install")
    assert "Passed" in repository.commit()
    text = break_(package)
    output = repository.commit(code=1)
    assert FINDING in output
    (package / "package.xml").write_text(text)
    with (package / "CMakeLists.txt").open("a") as file:
        file.write("# The end.\n")
    assert "Passed" in repository.commit()
    assert len(repository.run("git", "log", "--oneline").splitlines()) == 2


def test_a_commit_of_the_readme_alone_is_not_checked(
    tmp_path: Path, variables: dict[str, str]
) -> None:
    package = make(tmp_path)
    break_(package)
    repository = Repository(package, variables)
    repository.commit()
    repository.run("pre-commit", "install")
    (package / "README.md").write_text("# Talker\n")
    assert "Skipped" in repository.commit()


def test_all_files_of_a_new_package_pass(tmp_path: Path, variables: dict[str, str]) -> None:
    repository = Repository(make(tmp_path, "--comments", "tutorial"), variables)
    repository.run("git", "add", "-A")
    assert "Passed" in repository.run("pre-commit", "run", "--all-files", "--verbose")


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a repository with this tool as it is now, as its users clone it."""
    place = tmp_path_factory.mktemp("clone") / "tool"
    command = ["git", "-c", f"safe.directory={ROOT}", "ls-files", "-z", "-co", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, place / name)
    return place


def needs_index(scratch: Path) -> None:
    """Skip a test where pip cannot install what the tool is built with."""
    command = [sys.executable, "-m", "pip", "download", "--no-deps", "--quiet", "hatchling"]
    done = subprocess.run([*command, "--dest", scratch / "x"], capture_output=True, check=False)
    if done.returncode and os.environ.get(REQUIRE_ALL) != "1":
        pytest.skip("pip reaches no package index")


def installing() -> dict[str, str]:
    """Return the variables with which pip installs in this session."""
    names = [name for name in os.environ if name.startswith(("PIP_", "SSL_", "REQUESTS_"))]
    proxies = [name for name in os.environ if name.lower().endswith("_proxy")]
    given = {name: os.environ[name] for name in (*names, *proxies)}
    return {"PIP_NO_INDEX": "0", "PIP_CONFIG_FILE": "", **given}


def test_our_own_hook_runs_from_a_repository(
    clone: Path, tmp_path: Path, variables: dict[str, str]
) -> None:
    needs_index(tmp_path)
    tool = Repository(clone, variables)
    tool.commit()
    package = make(tmp_path)
    revision = tool.run("git", "rev-parse", "HEAD").strip()
    (package / CONFIG).write_text(
        f"repos:\n- repo: {clone}\n  rev: {revision}\n  hooks:\n  - id: ros2-scaffold\n"
    )
    repository = Repository(package, {**variables, **installing()})
    repository.run("pre-commit", "install", "--install-hooks")
    assert "Passed" in repository.commit()
    break_(package)
    assert FINDING in repository.commit(code=1)
