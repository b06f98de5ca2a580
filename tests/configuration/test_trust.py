"""No code of a checked repository runs; only the user or trusted files name code to load.

A canary is a file that code of the repository would write if anything ran it.
"""

from __future__ import annotations

import json
import marshal
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.ament import ruff
from scaffold.check.cache import rule_bytecode
from scaffold.check.result import Earlier
from scaffold.check.session import Session
from scaffold.cli.main import main
from scaffold.configuration import config, trust
from scaffold.errors import ConfigError, EnvironmentMissingError, InputError
from scaffold.files import cache
from scaffold.files.disk import Disk, digest, stamp
from scaffold.model.package import Package
from scaffold.programs import git, search

ROOT = Path(__file__).parents[2]
RULE = '''"""A rule of a stranger's."""

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule

open({canary!r}, "w").close()


class Planted(Rule):
    """It is loaded.

    **Why.** To be seen.

    **Fix.** None.

    **Source.** None.
    """

    code = "ZZ001"
    name = "planted"
    examples = (Example("none", {{}}),)

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield self.report(package.manifest.get("name")[0], "planted")
'''
TEMPLATE = "summary: Planted\nexamples: {}\n"
PACKAGE = """<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd" \
schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="3">
  <name>talker</name>
  <version>0.1.0</version>
  <description>Talks.</description>
  <maintainer email="ada@example.com">Ada Lovelace</maintainer>
  <license>Apache-2.0</license>

  <buildtool_depend>ament_cmake</buildtool_depend>

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project(talker)
find_package(ament_cmake REQUIRED)
ament_package()
"""


class Repository:
    """An untrusted checkout with a package, and code that its configuration names."""

    def __init__(self, root: Path, canary: Path) -> None:
        self.root = root
        self.canary = canary
        self.file = root / "ros2-scaffold.toml"
        self.write("talker/package.xml", PACKAGE)
        self.write("talker/CMakeLists.txt", CMAKE)
        self.write("talker/LICENSE", "")
        self.write("ros2-scaffold.toml", 'content = ["evil"]\n')
        self.plant("evil")

    def write(self, path: str, text: str) -> Path:
        """Write a file of the repository."""
        place = self.root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        return place

    def plant(self, directory: str) -> None:
        """Write a content directory with a rule and a template."""
        self.write(f"{directory}/rules/names/planted.py", RULE.format(canary=str(self.canary)))
        self.write(f"{directory}/templates/extras/planted/template.yaml", TEMPLATE)

    @property
    def has_run(self) -> bool:
        """Whether any code of the repository has run."""
        return self.canary.exists()


@pytest.fixture
def repository(own_cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """Return a repository that is the current directory, of a user without configuration."""
    for name, directory in (("HOME", "home"), ("XDG_CONFIG_HOME", "home/config")):
        monkeypatch.setenv(name, str(tmp_path / directory))
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    for name in (cache.SWITCH, "AMENT_PREFIX_PATH", "SUDO_UID"):
        monkeypatch.delenv(name, raising=False)
    root = tmp_path / "work" / "repository"
    root.mkdir(parents=True)
    subprocess.run(["git", "init", "--quiet", root], check=True)
    monkeypatch.chdir(root)
    return Repository(root, tmp_path / "canary")


Run = Callable[..., "Outcome"]


class Outcome:
    """What a command returned and wrote."""

    def __init__(self, code: int, out: str, err: str) -> None:
        self.code = code
        self.out = out
        self.err = err

    @property
    def ignored(self) -> list[str]:
        """The messages about ignored configuration."""
        return [line for line in self.err.splitlines() if " ignored" in line]


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Run a command in this process."""

    def command(*words: str) -> Outcome:
        try:
            code = main(words)
        except SystemExit as end:
            code = int(end.code or 0)
        return Outcome(code, *capsys.readouterr())

    return command


def program(*words: str) -> subprocess.CompletedProcess[str]:
    """Run a command in a process of its own, with the current directory on Python's path.

    It is there by an empty entry, as an unset variable in front of a colon leaves it behind.
    """
    # Without `site`, which imports what distributions ask for before any code of ours.
    path = os.pathsep.join(("", *filter(None, sys.path)))
    start = "from scaffold.cli.main import main; raise SystemExit(main())"
    return subprocess.run(
        [sys.executable, "-S", "-c", start, *words],
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )


COMMANDS = {
    "check": ("check", "talker"),
    "check everything": ("check",),
    "check as json": ("check", "--format", "json", "talker"),
    "fix": ("check", "--fix", "talker"),
    "diff": ("check", "--diff", "talker"),
    "rules": ("rules",),
    "rule": ("rules", "CM001"),
    "new": ("new", "listener"),
    "add": ("add", "launch", "--package-directory", "own"),
    "update": ("update", "own"),
    "templates": ("templates",),
    "help of new": ("new", "--help"),
    "help of add": ("add", "--help"),
}


@pytest.mark.parametrize("words", COMMANDS.values(), ids=COMMANDS)
def test_no_verb_runs_code_named_by_the_repository(
    repository: Repository, run: Run, words: tuple[str, ...]
) -> None:
    repository.file.unlink()
    if "own" in words:
        assert run("new", "own").code == 0
    repository.write("ros2-scaffold.toml", 'content = ["evil"]\n')
    outcome = run(*words)
    assert not repository.has_run
    assert outcome.code in {0, 1}
    assert "planted" not in outcome.out
    (line,) = outcome.ignored
    assert line.startswith(f"ros2-scaffold: warning: {repository.file}: 'content' ignored")
    assert line.endswith(f"ros2-scaffold trust {repository.root}")


@pytest.mark.parametrize("verb", ["interfaces", "completion bash"])
def test_other_verbs_ignore_configuration(repository: Repository, run: Run, verb: str) -> None:
    outcome = run(*verb.split())
    assert (outcome.code, outcome.err, repository.has_run) == (0, "", False)


def test_tab_completion_ignores_untrusted_content(repository: Repository) -> None:
    line = "ros2-scaffold new x --extras "
    done = subprocess.run(
        [sys.executable, "-c", "from scaffold.cli.main import main; main()"],
        env={
            **os.environ,
            "_ARGCOMPLETE": "1",
            "COMP_LINE": line,
            "COMP_POINT": str(len(line)),
            "_ARGCOMPLETE_STDOUT_FILENAME": str(repository.canary.parent / "words"),
        },
        capture_output=True,
        text=True,
        check=False,
    )
    words = (repository.canary.parent / "words").read_text()
    assert "launch" in words
    assert "planted" not in words
    assert (done.stderr, repository.has_run) == ("", False)


def test_content_flag_loads_code(repository: Repository, run: Run) -> None:
    outcome = run("rules", "--content", "evil")
    assert repository.has_run
    assert "ZZ001" in outcome.out
    assert outcome.err == ""


def test_user_configuration_loads_code(repository: Repository, run: Run, tmp_path: Path) -> None:
    repository.file.unlink()
    own = tmp_path / "home" / "config" / "ros2-scaffold" / "config.toml"
    own.parent.mkdir(parents=True)
    own.write_text(f'content = ["{repository.root}/evil"]\n')
    outcome = run("rules")
    assert ("ZZ001" in outcome.out, outcome.err) == (True, "")


@pytest.mark.parametrize("variable", ["XDG_CONFIG_HOME", "HOME"])
def test_file_in_the_repository_is_never_user_configuration(
    repository: Repository, run: Run, monkeypatch: pytest.MonkeyPatch, variable: str
) -> None:
    repository.file.unlink()
    monkeypatch.delenv("XDG_CONFIG_HOME")
    monkeypatch.setenv(variable, "planted")
    for place in ("planted/ros2-scaffold", "planted/.config/ros2-scaffold"):
        repository.write(f"{place}/config.toml", f'content = ["{repository.root}/evil"]\n')
        repository.write(f"{place}/trusted", f"{os.getuid()} {repository.root}\n")
    repository.write("ros2-scaffold.toml", 'content = ["evil"]\n')
    run("rules")
    assert not repository.has_run


def test_configuration_of_trusted_directory_loads_code(repository: Repository, run: Run) -> None:
    outcome = run("trust", ".")
    assert outcome.out.splitlines() == [
        f"trusted: {repository.root}",
        f"    rules and templates from {repository.root}/evil",
    ]
    assert not repository.has_run, "trusting runs nothing"
    for words in (["rules"], ["templates"], ["check", "talker"]):
        outcome = run(*words)
        assert ("lanted" in outcome.out, outcome.err) == (True, "")
    assert run("new", "listener", "--extras", "planted").code == 0
    assert run("trust", "--remove", ".").out == f"no longer trusted: {repository.root}\n"
    assert "ZZ001" not in run("rules").out


def test_trust_covers_exactly_one_directory(repository: Repository, run: Run) -> None:
    run("trust", "..")
    run("trust", "talker")
    assert run("rules").ignored
    (repository.root / "talker" / "ros2-scaffold.toml").write_text('content = ["../evil"]\n')
    os.chdir(repository.root / "talker")
    assert "ZZ001" in run("rules").out


@pytest.mark.usefixtures("repository")
def test_trusting_a_directory_without_configuration_is_noted(run: Run) -> None:
    outcome = run("trust", "talker")
    assert outcome.code == 0
    assert outcome.err.startswith("note: there is no ros2-scaffold.toml in ")


def test_symlink_to_a_trusted_file_is_not_trusted(repository: Repository, run: Run) -> None:
    other = repository.root.parent / "trusted"
    other.mkdir()
    (other / "ros2-scaffold.toml").write_text('content = ["evil"]\n')
    run("trust", str(other))
    repository.file.unlink()
    repository.file.symlink_to(other / "ros2-scaffold.toml")
    assert run("rules").ignored
    assert not repository.has_run


def test_trust_uses_the_real_path(repository: Repository, run: Run) -> None:
    link = repository.root.parent / "link"
    link.symlink_to(repository.root)
    assert run("trust", str(link / "talker" / "..")).out.startswith(f"trusted: {repository.root}\n")
    assert "ZZ001" in run("rules").out
    # What the link leads to later is another directory.
    link.unlink()
    stranger = Repository(repository.root.parent / "stranger", repository.canary)
    link.symlink_to(stranger.root)
    repository.canary.unlink()
    os.chdir(link)
    assert run("rules").ignored
    assert not repository.has_run


def test_moved_directory_is_no_longer_trusted(repository: Repository, run: Run) -> None:
    run("trust", ".")
    moved = repository.root.rename(repository.root.parent / "moved")
    os.chdir(moved)
    assert run("rules").ignored
    assert not repository.has_run
    assert run("trust", "--list").out == f"{repository.root}  (gone)\n"
    assert run("trust", "--remove", str(repository.root)).code == 0
    assert run("trust", "--list").out == ""


def test_directory_with_a_new_owner_is_no_longer_trusted(
    repository: Repository, run: Run, tmp_path: Path
) -> None:
    run("trust", ".")
    entries = tmp_path / "home" / "config" / "ros2-scaffold" / "trusted"
    owner = repository.root.stat().st_uid
    entries.write_text(entries.read_text().replace(f"{owner} ", f"{owner + 1} "))
    assert run("rules").ignored
    assert not repository.has_run
    assert "its owner has changed" in run("trust", "--list").out


@pytest.mark.usefixtures("repository")
def test_content_flag_overrides_ignored_configuration(run: Run) -> None:
    outcome = run("check", "--content", "evil", "talker")
    assert ("ZZ001" in outcome.out, outcome.err) == (True, "")
    run("trust", ".")
    assert run("check", "--content", "evil", "talker").code == outcome.code


def test_empty_content_list_needs_no_trust(repository: Repository, run: Run) -> None:
    repository.write("ros2-scaffold.toml", "content = []\n")
    assert run("rules").err == ""


@pytest.mark.parametrize(
    "value", ["3", '"evil"', "[3]", "[[]]", '[""]', r'["\u0000"]', "{ a = 1 }", "1979-05-27"]
)
def test_invalid_content_is_an_error(repository: Repository, run: Run, value: str) -> None:
    repository.write("ros2-scaffold.toml", f"content = {value}\n")
    for words in (["rules"], ["check", "talker"], ["trust", "."]):
        outcome = run(*words)
        assert outcome.code == 2
        assert outcome.err.endswith("content must be a list of directories\n")
    assert trust.trusted(Disk()) == {}


def test_ignored_message_escapes_control_characters(repository: Repository, run: Run) -> None:
    odd = repository.root / "a\x1b]0;b c"
    shutil.copytree(repository.root / "evil", odd / "evil")
    shutil.copy(repository.file, odd)
    os.chdir(odd)
    (line,) = run("rules").ignored
    assert "\x1b" not in line


# ---- the verb


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["trust"], "DIR is required"),
        (["trust", "nowhere"], "no such directory"),
        (["trust", "ros2-scaffold.toml"], "no such directory"),
        (["trust", "--remove", "talker"], "not trusted"),
        (["trust", "--list", "talker"], "--list takes no DIR"),
        (["trust", "--list", "--remove"], "not allowed with"),
    ],
)
@pytest.mark.usefixtures("repository")
def test_invalid_trust_arguments_are_one_error_line(
    run: Run, words: list[str], message: str
) -> None:
    outcome = run(*words)
    assert outcome.code == 2
    assert message in outcome.err
    assert outcome.err.count("\n") == 1


def test_world_writable_directory_cannot_be_trusted(repository: Repository) -> None:
    shared = repository.root / "shared"
    shared.mkdir()
    shared.chmod(0o1777)
    with pytest.raises(InputError, match="world-writable"):
        trust.add(str(shared))


@pytest.mark.parametrize("name", ["a b", "# c", "ü", os.fsdecode(b"\xff")])
@pytest.mark.usefixtures("repository")
def test_directory_with_odd_name_can_be_trusted(tmp_path: Path, name: str) -> None:
    directory = tmp_path / name
    directory.mkdir()
    real = trust.add(str(directory))
    assert trust.is_trusted(Disk(), real)
    assert trust.remove(str(directory)) == real
    assert trust.trusted(Disk()) == {}


@pytest.mark.parametrize("name", ["a\nb", "a\rb", "a\u2028b"])
@pytest.mark.usefixtures("repository")
def test_directory_name_with_newline_is_rejected(tmp_path: Path, name: str) -> None:
    (tmp_path / name).mkdir()
    with pytest.raises(InputError, match="line break"):
        trust.add(str(tmp_path / name))


def test_parallel_additions_are_all_kept(repository: Repository) -> None:
    names = [f"d{number}" for number in range(8)]
    for name in names:
        (repository.root / name).mkdir()
    code = "import sys; from scaffold.configuration import trust; trust.add(sys.argv[1])"
    running = [subprocess.Popen([sys.executable, "-c", code, name]) for name in names]
    assert [process.wait() for process in running] == [0] * len(names)
    assert set(trust.trusted(Disk())) == {str(repository.root / name) for name in names}


@pytest.mark.usefixtures("repository")
def test_symlinked_trust_list_stays_a_symlink(tmp_path: Path) -> None:
    directory = tmp_path / "home" / "config" / "ros2-scaffold"
    directory.mkdir(parents=True)
    (tmp_path / "dotfiles").mkdir()
    (directory / "trusted").symlink_to(tmp_path / "dotfiles" / "trusted")
    trust.add(str(tmp_path))
    assert (directory / "trusted").is_symlink()
    assert trust.is_trusted(Disk(), str(tmp_path))
    assert [path.name for path in directory.iterdir()] == ["trusted"]


@pytest.mark.usefixtures("repository")
def test_unwritable_trust_list_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "home").mkdir()
    (tmp_path / "home" / "config").write_text("a file")
    with pytest.raises(ConfigError, match="nothing was changed"):
        trust.add(str(tmp_path))


# ---- remembered results


def test_cached_results_depend_on_trust(
    repository: Repository, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    checked: list[str] = []
    check = Session.check_rules  # the place where the rules run

    def watched(session: Session, package: Package, *earlier: Earlier | None) -> object:
        checked.append(package.directory)
        return check(session, package, *earlier)

    monkeypatch.setattr(Session, "check_rules", watched)
    cold, warm = run("check", "talker"), run("check", "talker")
    assert checked == ["talker"], "the second run is remembered"
    assert (warm.code, warm.out, warm.err) == (cold.code, cold.out, cold.err)
    assert len(warm.ignored) == 1
    trust.add(".")
    for _ in range(2):
        trusted = run("check", "talker")
        assert ("ZZ001" in trusted.out, trusted.err) == (True, "")
    trust.remove(".")
    again = run("check", "talker")
    assert (again.code, again.out, again.err) == (cold.code, cold.out, cold.err)
    repository.write("ros2-scaffold.toml", "")
    assert run("check", "talker").err == ""


# ---- files of others


@pytest.fixture
def foreign(monkeypatch: pytest.MonkeyPatch) -> int:
    """Pretend to be another user than the owner of the files; return the owner."""
    owner = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    return owner


IGNORE = '[check]\nignore = ["PX"]\n'


def test_foreign_file_above_the_repository_is_ignored(
    repository: Repository, run: Run, foreign: int
) -> None:
    assert foreign == repository.root.stat().st_uid
    repository.file.unlink()
    above = repository.root.parent / "ros2-scaffold.toml"
    above.write_text("this is not TOML")
    outcome = run("check", "talker")
    assert outcome.code == 0
    (line,) = outcome.ignored
    assert line.startswith(f"ros2-scaffold: warning: {above}: ignored")
    assert str(repository.root) in line
    os.chdir(repository.root / "talker")
    assert len(run("check", ".").ignored) == 1


@pytest.mark.usefixtures("foreign")
def test_foreign_file_in_the_repository_is_used(repository: Repository) -> None:
    repository.file.write_text(IGNORE)
    settings = config.load(str(repository.root / "talker"))
    assert settings.strings("check.ignore") == ("PX",)
    assert settings.warnings == ()


@pytest.mark.usefixtures("foreign")
def test_all_foreign_files_above_the_repository_are_ignored(repository: Repository) -> None:
    repository.file.unlink()
    for directory in (repository.root.parent, repository.root.parent.parent):
        (directory / "ros2-scaffold.toml").write_text(IGNORE)
    settings = config.load(str(repository.root))
    assert len(settings.warnings) == 2
    assert settings.values == {}


def test_without_repository_foreign_files_in_parents_are_ignored(
    repository: Repository, foreign: int
) -> None:
    assert foreign == repository.root.stat().st_uid
    shutil.rmtree(repository.root / ".git")
    repository.file.write_text(IGNORE)
    assert config.load(str(repository.root)).strings("check.ignore") == ("PX",)
    settings = config.load(str(repository.root / "talker"))
    assert settings.values == {}
    assert len(settings.warnings) == 1


def test_own_file_above_the_repository_is_used(repository: Repository) -> None:
    repository.file.unlink()
    (repository.root.parent / "ros2-scaffold.toml").write_text(IGNORE)
    settings = config.load(str(repository.root / "talker"))
    assert (settings.strings("check.ignore"), settings.warnings) == (("PX",), ())


@pytest.mark.usefixtures("foreign")
def test_foreign_file_in_world_writable_repository_is_ignored(repository: Repository) -> None:
    repository.file.write_text(IGNORE)
    repository.root.chmod(0o1777)
    assert config.load(str(repository.root / "talker")).values == {}
    assert config.load(str(repository.root)).values == {}
    repository.root.chmod(0o777)  # a mount that knows no owners
    assert config.load(str(repository.root)).strings("check.ignore") == ("PX",)


def test_under_sudo_files_of_the_caller_are_used(
    repository: Repository, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.file.unlink()
    (repository.root.parent / "ros2-scaffold.toml").write_text(IGNORE)
    owner = repository.root.stat().st_uid
    monkeypatch.setenv("SUDO_UID", str(owner))
    monkeypatch.setattr(os, "geteuid", lambda: owner + 1)
    assert config.load(".").warnings, "only root was called by somebody"
    if owner:
        monkeypatch.setattr(os, "geteuid", lambda: 0)
        assert config.load(".").warnings == ()


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may give files away")
def test_cached_run_still_warns_of_foreign_file_and_sees_new_owner(
    repository: Repository, run: Run
) -> None:
    repository.file.unlink()
    above = repository.root.parent / "ros2-scaffold.toml"
    above.write_text('[check]\nselect = ["PX"]\n')
    own = run("check", "talker")
    assert own.ignored == []
    os.chown(above, 12345, 12345)
    cold, warm = run("check", "talker"), run("check", "talker")
    assert len(cold.ignored) == 1
    assert (warm.out, warm.err) == (cold.out, cold.err)
    os.chown(above, 0, 0)
    assert run("check", "talker").err == ""


@pytest.mark.skipif(os.geteuid() != 0, reason="only root may give files away")
def test_symlink_of_another_user_is_ignored(repository: Repository) -> None:
    repository.file.unlink()
    own = repository.write("elsewhere.toml", IGNORE)
    above = repository.root.parent / "ros2-scaffold.toml"
    above.symlink_to(own)
    os.lchown(above, 12345, 12345)
    settings = config.load(".")
    assert (settings.values, len(settings.warnings)) == ({}, 1)


# ---- other ways in


def _writes(canary: Path) -> str:
    return f"open({str(canary)!r}, 'w').close()\n"


def test_no_module_of_the_current_directory_is_imported(repository: Repository) -> None:
    repository.write("ros2-scaffold.toml", IGNORE)
    for name in (
        *("argparse", "json", "tomllib", "tomli", "enum", "subprocess", "xml/__init__", "yaml"),
        *("lxml/__init__", "lxml/etree", "jinja2/__init__", "pydocstyle/__init__", "tqdm"),
        *("snowballstemmer", "multiprocessing", "fnmatch", "tempfile", "hashlib", "difflib"),
    ):
        repository.write(f"{name}.py", _writes(repository.canary) + "raise ImportError\n")
    for verb in ("check", "rules", "templates", "new listener --dry-run"):
        done = subprocess.run(
            [sys.executable, "-m", "scaffold", *verb.split()],
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode in {0, 1}, done.stderr
        done = program(*verb.split())
        assert done.returncode in {0, 1}, done.stderr
    assert not repository.has_run


def test_checked_code_is_never_run(repository: Repository) -> None:
    code = _writes(repository.canary)
    repository.write("ros2-scaffold.toml", "")
    package = "talker/"
    for name in (
        *(
            "setup.py",
            "conftest.py",
            "test/test_talker.py",
            "talker/__init__.py",
        ),
        *("talker/talker.py", "launch/talker.launch.py", "noxfile.py", "docs/conf.py"),
        *("rules/names/planted.py", "scaffold/__init__.py", "sitecustomize.py"),
    ):
        repository.write(package + name, code)
    shell = f"touch {repository.canary}"
    repository.write(
        package + "CMakeLists.txt", f"execute_process(COMMAND {shell})\n{CMAKE}include(own.cmake)\n"
    )
    repository.write(package + "own.cmake", f"execute_process(COMMAND {shell})\n")
    repository.write(package + "Makefile", f"all:\n\t{shell}\n$(shell {shell})\n")
    repository.write(
        package + "setup.cfg",
        "[flake8:local-plugins]\nextension =\n  X = talker:talker\npaths = .\n",
    )
    for name in ("launch/talker.launch.xml", "config/talker.yaml"):
        repository.write(package + name, f"x: $(command '{shell}')\n")
    repository.write(
        package + "config/other.yaml", f"!!python/object/apply:os.system ['{shell}']\n"
    )
    for words in (("check",), ("check", "--fix", "talker"), ("check", "--reference", "talker")):
        done = program(*words)
        assert done.returncode in {0, 1}, done.stderr
    assert not repository.has_run


@pytest.mark.parametrize("prefix", ["", "f"])
def test_reference_mode_does_not_evaluate_strings(
    repository: Repository, run: Run, prefix: str
) -> None:
    """Pydocstyle evaluates ``__all__``; before Python 3.12 an f-string there is one token."""
    repository.write("ros2-scaffold.toml", "")
    call = "{" + f"open({str(repository.canary)!r}, \\'w\\')" + "}"
    if prefix:
        call = call.replace("\\'", '"').replace("'", '"')
    repository.write("talker/talker/all.py", f"__all__ = [{prefix}'{call}', 'x']\n")
    assert run("check", "--reference", "talker").code in {0, 3}
    assert not repository.has_run
    repository.write("talker/own.cfg", "[flake8]\n")  # asks for docstrings that are missing
    test = "from ament_flake8.main import main\nassert main(['--config', 'own.cfg']) == 0\n"
    repository.write("talker/test/test_flake8.py", test)
    repository.write(
        "talker/CMakeLists.txt", f"{CMAKE}ament_add_pytest_test(flake8 test/test_flake8.py)\n"
    )
    assert " D100 " in run("check", "talker", "--select", "D").out
    assert not repository.has_run


def test_ruff_configuration_of_the_repository_is_ignored(
    repository: Repository, run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository.write("ros2-scaffold.toml", "")
    repository.write("talker/talker/module.py", "import os\n")
    before = run("check", "talker").out
    assert "F401" in before
    settings = '[lint]\nselect = []\nignore = ["ALL"]\n'
    for name in ("ruff.toml", ".ruff.toml", "talker/ruff.toml"):
        repository.write(name, settings)
    repository.write("talker/pyproject.toml", '[tool.ruff]\nextend = "../ruff.toml"\n')
    repository.write("talker/.flake8", "[flake8]\nignore = F401\n")
    monkeypatch.setenv("RUFF_CONFIG", str(repository.root / "ruff.toml"))
    monkeypatch.setenv(cache.SWITCH, "1")
    assert run("check", "talker").out.count("F401") == before.count("F401")


def test_git_runs_no_program_of_the_repository(repository: Repository, run: Run) -> None:
    monitor = repository.write("monitor", f"#!/bin/sh\ntouch {repository.canary}\n")
    monitor.chmod(0o755)
    for key in ("core.fsmonitor", "core.pager", "pager.config", "alias.merge-file", "core.editor"):
        value = f"!{monitor}" if key.startswith("alias") else str(monitor)
        subprocess.run(["git", "config", key, value], check=True)
    hooks = repository.root / ".git" / "hooks"
    for name in ("post-index-change", "fsmonitor-watchman", "pre-commit"):
        (hooks / name).write_text(monitor.read_text())
        (hooks / name).chmod(0o755)
    git.run("status", directory=str(repository.root))
    repository.file.unlink()
    assert run("new", "own").code == 0
    assert run("update", "own").code == 0
    repository.write(".gitignore", "made.py\n")
    repository.write("own/made.py", "")
    assert "1 file ignored by git" in run("check", "own").out
    assert not repository.has_run
    subprocess.run(["git", "status"], check=False, capture_output=True)
    assert repository.has_run, "git alone does"


def test_reading_a_commit_runs_no_program_of_the_repository(
    repository: Repository, run: Run
) -> None:
    repository.write("ros2-scaffold.toml", "")
    repository.write("talker/talker/module.py", "import os\n")
    repository.write(".gitattributes", "* filter=evil diff=evil\n")
    subprocess.run(["git", "add", "."], check=True)
    identity = ("-c", "user.name=Ada", "-c", "user.email=ada@example.org")
    subprocess.run(["git", *identity, "commit", "--quiet", "-m", "all"], check=True)
    command = f"touch {repository.canary}; cat"
    for key in ("filter.evil.clean", "filter.evil.smudge", "filter.evil.process"):
        subprocess.run(["git", "config", key, command], check=True)
    for key in ("diff.evil.textconv", "diff.evil.command", "diff.external"):
        subprocess.run(["git", "config", key, command], check=True)
    repository.write("talker/talker/other.py", "import sys\n")
    repository.write("talker/CMakeLists.txt", CMAKE + "\n")
    outcome = run("check", "--since", "HEAD", "--select", "F", "talker")
    assert "other.py:1:1" in outcome.out
    assert "older finding" in outcome.out
    assert "module.py" not in outcome.out
    assert not repository.has_run
    subprocess.run(["git", "diff", "HEAD"], check=False, capture_output=True)
    assert repository.has_run, "git alone does"


def test_only_one_module_runs_git() -> None:
    places = [
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "scaffold").rglob("*.py")
        if re.search(r"""[\[(]["']git["'][,)]""", path.read_text())
    ]
    assert places == ["scaffold/programs/git.py"]


@pytest.mark.parametrize("entry", ["", ".", "bin"])
def test_programs_in_relative_path_entries_are_not_run(
    repository: Repository, run: Run, monkeypatch: pytest.MonkeyPatch, entry: str
) -> None:
    for name in ("git", "ruff"):
        script = repository.write(
            f"{entry or '.'}/{name}", f"#!/bin/sh\ntouch {repository.canary}\n"
        )
        script.chmod(0o755)
    own = search.find("git")
    monkeypatch.setenv("PATH", os.pathsep.join((entry, os.environ["PATH"])))
    assert search.find("git") == own
    repository.file.unlink()
    assert run("new", "own").code == 0
    # Without a ruff of the running Python, the PATH is asked.
    monkeypatch.setattr(sys, "executable", "")
    monkeypatch.setattr(sys, "prefix", str(repository.canary.parent / "nowhere"))
    monkeypatch.setitem(sys.modules, "ruff", None)
    monkeypatch.setenv("PATH", entry)
    with pytest.raises(EnvironmentMissingError):
        ruff._find()  # noqa: SLF001  `executable` remembers what it has found
    assert not repository.has_run


@pytest.mark.parametrize("key", ["kind", "text"])
def test_record_of_a_package_cannot_name_templates(
    repository: Repository, run: Run, key: str
) -> None:
    repository.file.unlink()
    assert run("new", "own", "--add", "publisher:laser").code == 0
    record = repository.root / "own" / ".ros2-scaffold.json"
    entries = json.loads(record.read_text())
    if key == "kind":
        entries["answers"]["add"][0]["kind"] = "../../evil/templates/extras/planted"
        entries["answers"]["content"] = ["../evil"]
    else:
        entries["answers"]["description"] = "{% include '/etc/passwd' %}{{ 7 * 191 }}"
    record.write_text(json.dumps(entries))
    outcome = run("update", "own")
    assert outcome.code == (2 if key == "kind" else 0)
    assert not repository.has_run
    files = [path for path in (repository.root / "own").rglob("*") if path.is_file()]
    assert not any(b"1337" in path.read_bytes() for path in files if path != record)


def test_answers_are_not_evaluated(repository: Repository, run: Run) -> None:
    repository.file.unlink()
    apply = f"!!python/object/apply:os.system ['touch {repository.canary}']"
    repository.write("answers.yaml", f"description: {apply}\n")
    assert run("new", "own", "--answers", "answers.yaml").code == 2
    assert not repository.has_run


def _plant_in_cache(repository: Repository, root: str) -> None:
    """Write code for the rules of a directory into the cache, as only its owner should."""
    kept = cache.directory("rules")
    assert kept is not None
    paths = [str(path) for path in sorted(Path(root).rglob("*.py"))]
    stamps = "\n".join([sys.version, *(f"{path} {stamp(path)}" for path in paths)])
    head = rule_bytecode._MAGIC + digest(stamps.encode()).encode()  # noqa: SLF001  what a stranger knows
    code = compile(_writes(repository.canary), "planted", "exec")
    place = os.path.join(kept, digest(os.path.abspath(root).encode()))
    assert cache.write_sealed(place, head, marshal.dumps([code]))


def _load(root: str) -> None:
    paths = [str(path) for path in sorted(Path(root).rglob("*.py"))]
    for code in rule_bytecode.codes(root, paths, lambda path: compile("", path, "exec")):
        exec(code, {})  # noqa: S102  as the rules are


def test_a_cache_in_the_repository_is_not_read(
    repository: Repository, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(repository.root / ".cache"))
    monkeypatch.chdir(tmp_path)
    _plant_in_cache(repository, str(repository.root / "evil" / "rules"))
    monkeypatch.chdir(repository.root / "talker")
    _load(str(repository.root / "evil" / "rules"))
    assert not repository.has_run
    assert cache.directory("rules") is None
    monkeypatch.chdir(tmp_path)
    _load(str(repository.root / "evil" / "rules"))
    assert repository.has_run, "elsewhere it is the user's choice"


@pytest.mark.usefixtures("foreign")
def test_cache_of_another_user_is_not_read(repository: Repository) -> None:
    _plant_in_cache(repository, str(repository.root / "evil" / "rules"))
    _load(str(repository.root / "evil" / "rules"))
    assert not repository.has_run
