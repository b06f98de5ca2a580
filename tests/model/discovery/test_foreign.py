"""Foreign files among the sources are not checked unless they are given explicitly."""

from __future__ import annotations

import random
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.files import cache
from scaffold.files.disk import Disk
from scaffold.model.discovery.foreign import WHERE, Foreign

MANIFEST = "<package format='3'><name>{}</name></package>\n"
FLAWED = "import os\n"
"""Code with one finding, F401."""


def git(directory: Path, *words: str) -> str:
    done = subprocess.run(
        ["git", "-c", "user.name=a", "-c", "user.email=a", "-C", str(directory), *words],
        check=True,
        capture_output=True,
        text=True,
    )
    return done.stdout


def write(directory: Path, files: dict[str, str]) -> None:
    for path, text in files.items():
        (directory / path).parent.mkdir(parents=True, exist_ok=True)
        (directory / path).write_text(text)


@pytest.fixture
def workspace(own_cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkout with a package of the user, and a foreign one in `other`."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.delenv(cache.SWITCH, raising=False)
    top = tmp_path / "ws"
    write(
        top,
        {
            "own/package.xml": MANIFEST.format("own"),
            "own/node.py": FLAWED,
            "other/msgs/package.xml": MANIFEST.format("other_msgs"),
            "other/msgs/node.py": FLAWED,
        },
    )
    git(tmp_path, "init", "-q", str(top))
    monkeypatch.chdir(top)
    return top


Check = Callable[..., tuple[list[str], list[str]]]


@pytest.fixture
def check(capsys: pytest.CaptureFixture[str]) -> Check:
    """Return the files with findings, and the notes of the report."""

    def run(*words: str) -> tuple[list[str], list[str]]:
        assert main(["check", "--select", "F", "--no-types", *words]) in (0, 1)
        *lines, _ = capsys.readouterr().out.splitlines()
        result = [line.partition(":")[0] for line in lines if " F401 " in line]
        return result, [line for line in lines if " F401 " not in line]

    return run


HINT = "(--include-all checks them)"


def submodule(top: Path) -> str:
    write(top, {".gitmodules": '[submodule "x"]\n\tpath = other\n\turl = https://example.com\n'})
    return "in submodules"


def ignored(top: Path) -> str:
    write(top, {".gitignore": "# from elsewhere\n/other/\n"})
    return "ignored by git"


def vendored(top: Path) -> str:
    (top / "other").rename(top / "third_party")
    write(top, {"third_party/msgs/LICENSE": "MIT\n"})
    return "of vendored code"


@pytest.mark.parametrize("make", [submodule, ignored, vendored])
def test_foreign_packages_are_not_checked(
    workspace: Path, check: Check, make: Callable[[Path], str]
) -> None:
    where = make(workspace)
    other = "third_party" if make is vendored else "other"
    for _ in range(2):  # the second time from memory
        assert check() == (["own/node.py"], [f"excluded by default: 1 package {where} {HINT}"])
    both = sorted(["own/node.py", f"{other}/msgs/node.py"])
    assert check("--include-all") == (both, [])
    for named in (other, f"{other}/msgs", f"{other}/msgs/node.py"):
        assert check(named) == ([f"{other}/msgs/node.py"], [])
    assert check("own", other)[1] == []


def test_submodules_are_named_at_the_top_of_the_checkout(workspace: Path, check: Check) -> None:
    submodule(workspace)
    (workspace / "other" / ".git").mkdir()
    write(workspace / "own", {".gitmodules": '[submodule "x"]\n\tpath = deep\n'})
    (workspace / "own" / "deep").mkdir()
    (workspace / "own" / "node.py").rename(workspace / "own" / "deep" / "node.py")
    assert check()[0] == ["own/deep/node.py"]


@pytest.mark.parametrize("make", [submodule, ignored, vendored])
def test_foreign_packages_are_checked_if_there_are_no_others(
    workspace: Path, check: Check, make: Callable[[Path], str]
) -> None:
    make(workspace)
    (workspace / "own/package.xml").unlink()
    (result,), notes = check()
    assert (Path(result).parts[1:], notes) == (("msgs", "node.py"), [])


def test_foreign_packages_are_known_to_other_packages(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    depends = MANIFEST.replace("</name>", "</name><depend>other_msgs</depend>")
    write(
        workspace,
        {
            "own/package.xml": depends.format("own"),
            "own/node.py": "from other_msgs.msg import Missing\n\nprint(Missing())\n",
            "other/msgs/CMakeLists.txt": "project(other_msgs)\n"
            "rosidl_generate_interfaces(other_msgs msg/Given.msg)\n",
            "other/msgs/msg/Given.msg": "int8 x\n",
        },
    )
    submodule(workspace)
    main(["check", "--select", "TY"])
    assert "other_msgs" in capsys.readouterr().out
    (workspace / "other/msgs/package.xml").unlink()
    main(["check", "--select", "TY"])
    assert "other_msgs" not in capsys.readouterr().out


def test_foreign_files_are_not_checked(workspace: Path, check: Check) -> None:
    write(
        workspace,
        {
            "own/.gitignore": "made_*.py\ngenerated/\n!made_up.py\n",
            "own/made_by_build.py": FLAWED,
            "own/made_up.py": FLAWED,
            "own/generated/a.py": FLAWED,
            "own/generated/b.py": FLAWED,
            "own/node.sync-conflict-20260101-1.py": FLAWED,
            "own/thirdparty/json/LICENSE.MIT": "MIT\n",
            "own/thirdparty/json/json.py": FLAWED,
            "own/vendor/mine.py": FLAWED,
            "own/venv/pyvenv.cfg": "",
            "own/venv/lib/module.py": FLAWED,
        },
    )
    result, notes = check("own")
    assert result == ["own/made_up.py", "own/node.py", "own/vendor/mine.py"]
    left_out = "3 files ignored by git, 2 files of vendored code"
    copies = "1 file left by editors or synchronization"
    assert notes == [f"excluded by default: {left_out}, {copies} {HINT}, 1 virtual environment"]
    assert check("own/generated/a.py") == (["own/generated/a.py"], [])
    assert len(check("own", "--include-all")[0]) == len(result) + 5
    git(workspace, "add", "-f", "own/generated/a.py")
    assert "own/generated/a.py" in check("own")[0], "git tracks it now"


def test_default_excludes_can_be_configured(workspace: Path, check: Check) -> None:
    write(workspace, {"own/node~.py": "", "own/.#node.py": FLAWED, "own/.gitignore": "node.py\n"})
    assert check("own")[0] == []
    write(workspace, {"ros2-scaffold.toml": '[check]\ndefault-excludes = ["gitignored"]\n'})
    assert check("own")[0] == ["own/.#node.py"]
    write(workspace, {"ros2-scaffold.toml": "[check]\ndefault-excludes = []\n"})
    assert check("own")[0] == ["own/.#node.py", "own/node.py"]


def test_changed_gitignore_invalidates_the_cache(workspace: Path, check: Check) -> None:
    assert check("own")[0] == ["own/node.py"]
    write(workspace, {".gitignore": "node.py\n"})
    assert check("own")[0] == []
    git(workspace, "add", "-f", "own/node.py")
    assert check("own")[0] == ["own/node.py"]


# -- what git ignores

NAMES = ["a", "b", "foo", "bar.py", "x.txt", "a b", "#c", "!d", "foo.py~", "d.e"]
PATTERNS = [
    *("*", "**", "?", "a", "b", "foo", "bar.py", "*.py", "*.txt", "[ab]", "[!a]", "foo*", "**/a"),
    *("a/**", "b/**/foo", "a/*", "\\#c", "\\!d", "*.e", "a b", "x.*", "[a-d].e", "fo?", "# a", ""),
]


def random_pattern(chance: random.Random) -> str:
    text = "/".join(chance.choice(PATTERNS) for _ in range(chance.choice([1, 1, 1, 2, 3])))
    text = chance.choice(["", "", "", "!", "/"]) + text
    return text + chance.choice(["", "", "", "/", "  "])


@pytest.mark.parametrize("seed", range(15))
def test_ignored_files_equal_those_of_git(tmp_path: Path, seed: int) -> None:
    chance = random.Random(seed)  # noqa: S311  chance, not secrecy
    git(tmp_path, "init", "-q")
    directories = [tmp_path]
    for _ in range(8):
        directory = chance.choice(directories) / chance.choice(NAMES)
        if not directory.exists():
            directory.mkdir()
            directories.append(directory)
    files = {chance.choice(directories) / chance.choice(NAMES) for _ in range(25)}
    files = {path for path in files if not path.exists()}
    for path in files:
        path.touch()
    for directory in {tmp_path, *chance.sample(directories, 2)}:
        lines = "".join(f"{random_pattern(chance)}\n" for _ in range(chance.randint(1, 5)))
        (directory / ".gitignore").write_text(lines)
    git(tmp_path, "add", "-f", "--", *map(str, sorted(files)[:2]))
    listed = git(tmp_path, "ls-files", "-z", "-o", "-i", "--exclude-standard").split("\0")
    foreign = Foreign([*WHERE][1:2])
    foreign.name([str(tmp_path.resolve())])
    own = {
        str(path.relative_to(tmp_path))
        for path in files
        if foreign.kind_of(Disk(), str(path.resolve()), is_directory=False)
    }
    assert own == {path for path in listed if path and not path.endswith(".gitignore")}
