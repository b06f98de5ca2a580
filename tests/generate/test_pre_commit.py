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
FINDING = "imports 'std_msgs', which package.xml does not declare"


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
    """An environment with the command, without user configuration and package index."""
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


def remove_dependency(package: Path) -> str:
    """Remove a dependency; return the original manifest."""
    manifest = package / "package.xml"
    text = manifest.read_text()
    lines = [line for line in text.splitlines(keepends=True) if "std_msgs" not in line]
    manifest.write_text("".join(lines))
    return text


def test_commit_fails_with_findings_and_passes_without(
    tmp_path: Path, variables: dict[str, str]
) -> None:
    package = make(tmp_path)
    repository = Repository(package, variables)
    repository.run("pre-commit", "install")
    assert "Passed" in repository.commit()
    text = remove_dependency(package)
    output = repository.commit(code=1)
    assert FINDING in output
    (package / "package.xml").write_text(text)
    with (package / "CMakeLists.txt").open("a") as file:
        file.write("# The end.\n")
    assert "Passed" in repository.commit()
    assert len(repository.run("git", "log", "--oneline").splitlines()) == 2


def test_commit_of_only_the_readme_is_not_checked(
    tmp_path: Path, variables: dict[str, str]
) -> None:
    package = make(tmp_path)
    remove_dependency(package)
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


@pytest.fixture
def shared(clone: Path, tmp_path: Path, variables: dict[str, str]) -> Repository:
    """Return a repository with two packages and our own hooks, as the commits begin."""
    needs_index(tmp_path)
    variables["PRE_COMMIT_HOME"] = str(clone.parent / "pre-commit")  # installed once
    is_new = not (clone / ".git").exists()
    tool = Repository(clone, variables)
    if is_new:
        tool.commit()
    revision = tool.run("git", "rev-parse", "HEAD").strip()
    top = tmp_path / "shared"
    for name in ("listener", "talker"):
        assert main(["new", name, *PERSON, "--destination-directory", str(top / "src")]) == 0
    hooks = "".join(f"  - id: {name}\n" for name in ("ros2-scaffold-fix", "ros2-scaffold-check"))
    (top / CONFIG).write_text(f"repos:\n- repo: {clone}\n  rev: {revision}\n  hooks:\n{hooks}")
    (top / "setup.py").write_text("# of no package\n")
    remove_dependency(top / "src" / "listener")
    repository = Repository(top, {**variables, **installing()})
    repository.commit()
    repository.run("pre-commit", "install", "--install-hooks")
    return repository


def test_hooks_of_this_repository_run(shared: Repository) -> None:
    node = shared.top / "src" / "talker" / "talker" / "minimal_publisher.py"
    text = node.read_text()

    # An edit of Python breaks the manifest: the fix is made, and the commit fails for it.
    imported = "import geometry_msgs.msg  # noqa: F401\nfrom rcl_interfaces"
    node.write_text(text.replace("from rcl_interfaces", imported))
    output = shared.commit(code=1)
    assert "ros2-scaffold check --fix" in output
    assert "files were modified by this hook" in output
    assert "1 fix applied" in output
    assert (
        "<exec_depend>geometry_msgs</exec_depend>"
        in (shared.top / "src" / "talker" / "package.xml").read_text()
    )
    assert "listener" not in output  # broken, but not part of the commit
    assert shared.commit().count("Passed") == 2

    # What has no safe fix is reported by its text until the author ends it.
    node.write_text(text.replace("String", "Strin"))
    output = shared.commit(code=1)
    assert "Strin" in output
    assert "src/talker/talker/minimal_publisher.py" in output
    node.write_text(node.read_text().replace("Strin", "String"))
    shared.commit()

    # Files that no verdict depends on start nothing; other files of no package are skipped.
    (shared.top / "src" / "listener" / "README.md").write_text("# Listener\n")
    assert shared.commit().count("Skipped") == 2
    (shared.top / "setup.py").write_text("import nothing\n")
    assert shared.commit().count("Passed") == 2

    # All files are all packages.
    output = shared.run("pre-commit", "run", "--all-files", "ros2-scaffold-check", code=1)
    assert "src/listener/" in output
    assert FINDING in output


def test_hook_of_earlier_versions_checks_all_packages(shared: Repository) -> None:
    configuration = shared.top / CONFIG
    text = configuration.read_text()
    kept = [line for line in text.splitlines() if "ros2-scaffold-fix" not in line]
    configuration.write_text("\n".join(kept).replace("ros2-scaffold-check", "ros2-scaffold"))
    (shared.top / "setup.py").write_text("import nothing\n")
    output = shared.commit(code=1)
    assert "src/listener/" in output
    assert FINDING in output
