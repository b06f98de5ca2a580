"""Cached results: unchanged packages are not checked again, and every change is noticed."""

from __future__ import annotations

import ast
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from scaffold.check import runner
from scaffold.check.cache import runs as memory
from scaffold.check.result import Earlier
from scaffold.check.rules import registry
from scaffold.check.session import Session
from scaffold.cli.main import main
from scaffold.diagnostic import Diagnostic
from scaffold.files import cache
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package
from scaffold.model.python.module import PythonModule

MANIFEST = """<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd" \
schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="3">
  <name>{}</name>
  <version>0.1.0</version>
  <description>An example</description>
  <maintainer email="ann@example.com">Ann</maintainer>
  <license>Apache-2.0</license>
{}  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
SETUP = """from setuptools import find_packages, setup

setup(
    name='{0}',
    version='0.1.0',
    packages=find_packages(),
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/{0}']),
        ('share/{0}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={{'console_scripts': ['talk = {0}.talk:main']}},
)
"""
TALK = '''"""Says hello."""


def main():
    """Say it."""
    print('hello')
'''


def write(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def make_package(root: Path, name: str, dependencies: str = "") -> Path:
    write(
        root / name,
        {
            "package.xml": MANIFEST.format(name, dependencies),
            "setup.py": SETUP.format(name),
            "setup.cfg": f"[develop]\nscript_dir=$base/lib/{name}\n"
            f"[install]\ninstall_scripts=$base/lib/{name}\n",
            f"resource/{name}": "",
            f"{name}/__init__.py": "",
            f"{name}/talk.py": TALK,
            "LICENSE": "Apache\n",
        },
    )
    return root / name


class Runs:
    """Runs `check` in this process and records which packages were really checked."""

    def __init__(
        self,
        monkeypatch: pytest.MonkeyPatch,
        capsys: pytest.CaptureFixture[str],
        new_cache: Callable[[], Path],
    ) -> None:
        self.checked: list[str] = []
        self._capsys = capsys
        self._new_cache = new_cache
        check = Session.check_rules  # the place where the rules run

        def watched(session: Session, package: Package, *earlier: Earlier | None) -> object:
            self.checked.append(os.path.basename(package.directory))
            return check(session, package, *earlier)

        monkeypatch.setattr(Session, "check_rules", watched)

    def __call__(self, *words: str) -> str:
        """Return the output of `check`; ``checked`` lists the packages that this run checked."""
        self.checked.clear()
        self.code = main(["check", *words])
        out, err = self._capsys.readouterr()
        assert err == ""
        return out

    def first(self, *words: str) -> str:
        """Return the output of `check` that finds no results in its cache."""
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("XDG_CACHE_HOME", str(self._new_cache()))
            return self(*words)

    def settle(self, *words: str) -> str:
        """Check, and make sure that the same run is cached."""
        first = self(*words)
        assert self(*words) == first
        assert self.checked == []
        return first


@pytest.fixture
def source(tmp_path: Path) -> Path:
    (tmp_path / "src").mkdir()
    return tmp_path / "src"


@pytest.fixture
def runs(
    tmp_path: Path,
    source: Path,
    own_cache: Path,
    new_cache: Callable[[], Path],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> Runs:
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.delenv(cache.SWITCH, raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    # Somebody may edit the tool while its tests run; what that does, one of them shows.
    tool = memory.tool()
    monkeypatch.setattr(memory, "tool", lambda: tool)
    monkeypatch.chdir(source)
    return Runs(monkeypatch, capsys, new_cache)


@pytest.fixture
def package(source: Path) -> Path:
    return make_package(source, "talker")


def test_unchanged_package_is_not_checked_again(runs: Runs, package: Path) -> None:
    (package / "talker" / "talk.py").write_text("import os\n")
    first = runs(".")
    assert runs.checked == ["talker"]
    assert (runs.code, "F401" in first) == (1, True)
    assert runs(".") == first
    assert (runs.code, runs.checked) == (1, [])


@pytest.mark.usefixtures("package")
def test_cached_run_loads_neither_rules_nor_ruff(
    runs: Runs, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs(".")

    def fail(roots: object) -> None:
        raise AssertionError(roots)

    monkeypatch.setattr(registry, "load", fail)
    runs(".")
    assert runs.code == 0


# -- every change is seen


def edit(package: Path) -> None:
    (package / package.name / "talk.py").write_text("import os\n")


def edit_in_the_same_size_and_time(package: Path) -> None:
    path = package / "talker" / "talk.py"
    before = path.stat()
    path.write_text(TALK.replace("print('hello')", 'print("hallo")'))
    assert path.stat().st_size == before.st_size
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def touch_new_module(package: Path) -> None:
    (package / "talker" / "extra.py").write_text("import os\n")


def remove_marker(package: Path) -> None:
    (package / "resource" / "talker").unlink()


def rename_module(package: Path) -> None:
    (package / package.name / "talk.py").rename(package / package.name / "walk.py")


def new_executable(package: Path) -> None:
    setup = package / "setup.py"
    setup.write_text(setup.read_text().replace("talk = ", "walk = "))


def rename_package(package: Path) -> None:
    (package / "package.xml").write_text(MANIFEST.format("renamed", ""))


def link_to_nowhere(package: Path) -> None:
    (package / "resource" / "talker").unlink()
    (package / "resource" / "talker").symlink_to("nowhere")


def new_directory(package: Path) -> None:
    (package / "talker" / "sub").mkdir()
    (package / "talker" / "sub" / "talk.py").write_text("import os\n")


def configure(package: Path) -> None:
    (package.parent / "ros2-scaffold.toml").write_text('[check]\nselect = ["PX"]\n')


def configure_above(package: Path) -> None:
    (package.parent.parent / "ros2-scaffold.toml").write_text('[check]\nignore = ["PX"]\n')


def configure_user(package: Path) -> None:
    path = package.parent.parent / "config" / "ros2-scaffold" / "config.toml"
    path.parent.mkdir(parents=True)
    path.write_text('[check]\nignore = ["PX"]\n')


def ignore_package(package: Path) -> None:
    (package / "COLCON_IGNORE").touch()
    make_package(package.parent, "other")


def new_neighbor(package: Path) -> None:
    make_package(package.parent, "neighbor")


def remove_licence(package: Path) -> None:
    (package / "LICENSE").unlink()


CHANGES: list[Callable[[Path], None]] = [
    edit,
    edit_in_the_same_size_and_time,
    touch_new_module,
    remove_marker,
    rename_module,
    rename_package,
    link_to_nowhere,
    new_directory,
    configure,
    configure_above,
    configure_user,
    ignore_package,
    remove_licence,
    new_neighbor,
]


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.__name__)
def test_change_is_noticed(runs: Runs, package: Path, change: Callable[[Path], None]) -> None:
    runs.settle(".")
    change(package)
    reported = runs(".")
    assert runs.checked != []
    assert runs.first(".") == reported


def test_changed_file_mode_is_noticed(runs: Runs, tmp_path: Path) -> None:
    write(
        tmp_path / "src" / "mover",
        {
            "package.xml": MANIFEST.format("mover", "").replace("ament_python", "ament_cmake"),
            "CMakeLists.txt": "cmake_minimum_required(VERSION 3.20)\nproject(mover)\n"
            "find_package(ament_cmake REQUIRED)\n"
            "install(PROGRAMS scripts/move.py DESTINATION lib/${PROJECT_NAME})\n"
            "ament_package()\n",
            "scripts/move.py": "#!/usr/bin/env python3\n" + TALK,
        },
    )
    script = tmp_path / "src" / "mover" / "scripts" / "move.py"
    script.chmod(0o755)
    before = runs.settle(".")
    script.chmod(0o644)
    after = runs(".")
    assert runs.checked == ["mover"]
    assert before != after


def test_added_license_in_a_parent_directory_is_noticed(runs: Runs, package: Path) -> None:
    (package / "LICENSE").unlink()
    assert "LY006" in runs.settle(".")
    (package.parent / "LICENSE").write_text("Apache\n")
    assert "LY006" not in runs(".")


def test_dependencies_outside_of_packages_survive_a_partial_run(
    runs: Runs, workspace: Path
) -> None:
    (workspace / "alone" / "LICENSE").unlink()
    assert "LY006" in runs.settle(".")
    edit(workspace / "lonely")
    assert "LY006" in runs(".")
    assert runs.checked == ["lonely"]
    (workspace / "LICENSE").write_text("Apache\n")
    assert "LY006" not in runs(".")


def test_changed_definitions_in_ament_prefix_path_are_noticed(
    runs: Runs, package: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    message = tmp_path / "prefix" / "share" / "robot_msgs" / "msg" / "State.msg"
    write(message.parent, {"State.msg": "int32 number\n"})
    write(
        package,
        {
            "talker/talk.py": '"""Says hello."""\nfrom robot_msgs.msg import State\n\n'
            "import rclpy\n\n\ndef main():\n"
            '    """Say it."""\n    rclpy.init()\n'
            "    print(State(number=1))\n",
            "package.xml": MANIFEST.format(
                "talker",
                "".join(f"  <depend>{item}</depend>\n" for item in ("rclpy", "robot_msgs")),
            ),
        },
    )
    without = runs.settle(".")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "prefix"))
    assert runs.settle(".") == without
    message.write_text("int32 value\n")
    assert "'number'" in runs(".")
    message.unlink()
    runs(".")
    assert runs.checked == ["talker"]


@pytest.mark.parametrize("where", ["rules/package_xml/license_todo.py", "scaffold/check/runner.py"])
def test_edited_rule_is_noticed(tmp_path: Path, where: str) -> None:
    """Uses a copy of the tool, since the one under test is shared."""
    root = Path(__file__).resolve().parents[3]
    for part in ("scaffold", "rules"):
        shutil.copytree(root / part, tmp_path / part, ignore=shutil.ignore_patterns("__pycache__"))
    before = _tool_in(tmp_path)
    assert _tool_in(tmp_path) == before
    with (tmp_path / where).open("a") as file:
        file.write("\n")
    assert _tool_in(tmp_path) != before


def _tool_in(root: Path) -> str:
    import subprocess

    code = "from scaffold.check.cache import runs; print(runs.tool())"
    environment = {**os.environ, "PYTHONPATH": str(root), "PYTHONDONTWRITEBYTECODE": "1"}
    return subprocess.run(
        [sys.executable, "-c", code], cwd=root, env=environment, check=True, stdout=-1
    ).stdout.decode()


def test_results_depend_on_flags_and_directory(
    runs: Runs, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (package / "talker" / "talk.py").write_text("import os\n")
    everything = runs.settle(".")
    assert runs.settle(".", "--select", "PX") != everything
    assert runs.settle(".", "--format", "json") != everything
    assert runs.settle("talker/setup.py") != everything
    monkeypatch.chdir(package)
    assert "src/talker" not in runs.settle(".")


# -- workspaces


@pytest.fixture
def workspace(source: Path) -> Path:
    for name in ("alone", "lonely"):
        make_package(source, name)
    make_package(source, "caller", "  <exec_depend>called</exec_depend>\n")
    make_package(source, "called")
    return source


def write_launch(workspace: Path) -> None:
    write(
        workspace / "caller",
        {
            "launch/call.launch.py": "from launch import LaunchDescription\n"
            "from launch_ros.actions import Node\n\n\n"
            "def generate_launch_description():\n"
            "    return LaunchDescription([Node(package='called', executable='talk')])\n"
        },
    )


def test_only_dependents_of_a_change_are_checked_again(runs: Runs, workspace: Path) -> None:
    write_launch(workspace)
    before = runs.settle(".")
    (workspace / "alone" / "alone" / "talk.py").write_text("import os\n")
    reported = runs(".")
    assert runs.checked == ["alone"]
    assert set(reported.splitlines()[:-1]) > set(before.splitlines()[:-1])
    assert runs(".") == reported
    assert runs.checked == []


def test_change_in_another_package_is_noticed(runs: Runs, workspace: Path) -> None:
    write_launch(workspace)
    assert "LF002" not in runs.settle(".")
    new_executable(workspace / "called")
    reported = runs(".")
    assert sorted(runs.checked) == ["called", "caller"]
    assert "caller/launch/call.launch.py" in reported


def test_new_user_of_an_unused_module_in_another_package_is_noticed(
    runs: Runs, workspace: Path
) -> None:
    write(
        workspace / "called",
        {
            "called/left.py": '"""Help."""\n\n\ndef work():\n    """Work."""\n    return missing\n',
            "called/other.py": '"""Help."""\n',
        },
    )
    options = (".", "--select", "F821", "--no-types")
    assert "warning F821" in runs.settle(*options)
    talk = workspace / "caller" / "caller" / "talk.py"
    talk.write_text(talk.read_text() + "\n\nfrom called.left import work\n\nwork()\n")
    assert "error F821" in runs(*options)


@pytest.mark.parametrize("count", [0, 10])
def test_partial_run_reports_the_same_as_a_full_one(
    runs: Runs, workspace: Path, count: int
) -> None:
    """With ten more packages, worker processes are used."""
    write_launch(workspace)
    for number in range(count):
        make_package(workspace, f"more_{number}")
    runs.settle(".")
    for change, item in (
        (edit, "alone"),
        (rename_module, "called"),
        (rename_package, "lonely"),
        (shutil.rmtree, "called"),
        (remove_licence, "caller"),
        (new_neighbor, "caller"),
    ):
        change(workspace / item)
        reported = runs(".")
        assert runs.first(".") == reported
        assert runs(".") == reported


@pytest.mark.parametrize("count", [0, 10])
def test_change_in_packages_that_are_not_checked_is_noticed(
    runs: Runs, workspace: Path, count: int
) -> None:
    """Only some packages are checked; the one that a launch file needs is not."""
    write_launch(workspace)
    more = [make_package(workspace, f"more_{number}") for number in range(count)]
    given = ["caller", "alone", *(item.name for item in more)]
    runs.settle(*given)
    for change in (rename_module, new_executable, shutil.rmtree):
        change(workspace / "called")
        reported = runs(*given)
        assert runs.first(*given) == reported


def test_changed_interfaces_of_another_package_are_noticed(runs: Runs, workspace: Path) -> None:
    message = workspace / "robot_msgs" / "msg" / "State.msg"
    write(
        workspace,
        {
            "robot_msgs/package.xml": MANIFEST.format("robot_msgs", ""),
            "robot_msgs/msg/State.msg": "int32 number\n",
            "alone/alone/talk.py": '"""Says hello."""\nfrom robot_msgs.msg import State\n\n'
            "import rclpy\n\n\ndef main():\n"
            '    """Say it."""\n    rclpy.init()\n'
            "    print(State(number=1))\n",
        },
    )
    assert "'number'" not in runs.settle(".")
    message.write_text("int32 value\n")
    assert "'number'" in runs(".")
    assert sorted(runs.checked) == ["alone", "robot_msgs"]


# -- how it is shown


@pytest.mark.parametrize(
    "words",
    [
        *(["--statistics"], ["--style"], ["--all"], ["--severity", "error"], ["--quiet"]),
        *(["--format", name] for name in ("json", "sarif", "github", "gitlab", "junit")),
        ["--exit-zero"],
    ],
    ids=" ".join,
)
def test_other_output_formats_use_the_cache(
    runs: Runs, package: Path, words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (package / "talker" / "talk.py").write_text(TALK.replace("'hello'", '"hello"'))
    runs.settle(str(package))
    shown = runs(str(package), *words)
    assert runs.checked == []
    assert runs.first(str(package), *words) == shown
    assert runs.checked == ["talker"]


@pytest.mark.usefixtures("package")
def test_edit_is_noticed_for_each_output_format(runs: Runs, package: Path) -> None:
    for words in ([], ["--format", "json"]):
        runs.settle(".", *words)
    (package / "talker" / "talk.py").write_text(TALK.replace("'hello'", '"hello"'))
    assert "Q000" in runs(".")
    assert runs.checked == ["talker"]
    assert "Q000" in runs(".", "--format", "json")
    assert runs.checked == []


@pytest.mark.usefixtures("package")
def test_edited_baseline_is_noticed(runs: Runs, package: Path, tmp_path: Path) -> None:
    (package / "talker" / "talk.py").write_text(TALK.replace("'hello'", '"hello"'))
    baseline = tmp_path / "baseline.json"
    runs(".", "--write-baseline", str(baseline))
    whole = baseline.read_text()
    runs.settle(".")
    assert "Q000" not in runs.settle(".", "--baseline", str(baseline))
    runs(".", "--select", "PX", "--write-baseline", str(baseline))
    assert baseline.read_text() != whole
    assert "Q000" in runs(".", "--baseline", str(baseline))


# -- fixes


def test_fixes_are_applied_to_the_current_files(runs: Runs, package: Path) -> None:
    module = package / "talker" / "talk.py"
    module.write_text(TALK.replace("'hello'", '"hello"'))
    before = runs.settle(".")
    assert "Q000" in before
    assert main(["check", "--fix", "."]) == 0
    assert module.read_text() == TALK
    assert "Q000" not in runs._capsys.readouterr().out  # noqa: SLF001
    assert "Q000" not in runs(".")


# -- the file


@pytest.fixture
def results_file(runs: Runs, package: Path, own_cache: Path) -> Path:
    """Return the cache file with the results of a run; another one has its report."""
    runs.settle(str(package))
    files = (own_cache / "ros2-scaffold" / "runs").iterdir()
    return max(files, key=lambda file: file.stat().st_size)


@pytest.mark.parametrize("keep", [0, 10, 60, 200, -1])
def test_truncated_cache_file_is_ignored_and_replaced(
    runs: Runs, package: Path, results_file: Path, keep: int
) -> None:
    whole = results_file.read_bytes()
    results_file.write_bytes(whole[:keep])
    runs(str(package))
    assert runs.checked == ["talker"]
    runs(str(package))
    assert runs.checked == []


def test_damaged_cache_file_is_ignored(package: Path, results_file: Path) -> None:
    whole = bytearray(results_file.read_bytes())
    for at in range(0, len(whole), 97):
        damaged = bytearray(whole)
        damaged[at] ^= 0x41
        results_file.write_bytes(damaged)
        entry = memory.ReportEntry.of(["check", str(package)])
        assert entry is not None
        assert entry.current() is None


@pytest.mark.usefixtures("package")
def test_disabled_cache_is_neither_read_nor_written(
    runs: Runs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv(cache.SWITCH, "1")
    for _ in range(2):
        runs(".")
        assert runs.checked == ["talker"]
    assert not (tmp_path / "cache").exists()


@pytest.mark.usefixtures("package")
def test_unwritable_cache_is_ignored(
    runs: Runs, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "cache").write_text("a file")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    for _ in range(2):
        runs(".")
        assert runs.checked == ["talker"]


@pytest.mark.parametrize(
    ("module", "limit", "value", "most"),
    [(memory, "MAX_RUNS", 4, 4), (cache, "MAX_BYTES", 12_000, 6)],
)
@pytest.mark.usefixtures("package")
def test_old_runs_are_deleted(
    runs: Runs,
    own_cache: Path,
    monkeypatch: pytest.MonkeyPatch,
    module: ModuleType,
    limit: str,
    value: int,
    most: int,
) -> None:
    """Five runs write ten files: findings of 4 kB, more with a long path, and reports of 200 B."""
    monkeypatch.setattr(module, limit, value)
    for code in ("PX", "SP", "LY", "NM", "ND"):
        runs(".", "--select", code)
    directory = own_cache / "ros2-scaffold" / "runs"
    assert 1 <= len(list(directory.iterdir())) <= most
    runs(".", "--select", "ND")
    assert runs.checked == []


def test_schema_that_includes_others_is_not_used(runs: Runs, package: Path) -> None:
    """Files opened by libxml2 itself would not be recorded, so it must open none."""
    schema = '<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">{}</xs:schema>\n'
    write(
        package,
        {
            "description.xml": '<a xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
            'xsi:noNamespaceSchemaLocation="a.xsd"/>\n',
            "a.xsd": schema.format('<xs:include schemaLocation="../b.xsd"/>'),
        },
    )
    other = package.parent / "b.xsd"
    other.write_text(schema.format('<xs:element name="a"/>'))
    first = runs(".")
    assert "PX052" in first
    other.write_text(schema.format('<xs:element name="b"/>'))
    assert runs(".") == first
    (package / "a.xsd").write_text(schema.format('<xs:element name="b"/>'))
    assert "PX051" in runs(".")


def test_package_changed_during_the_run_is_not_cached(
    runs: Runs, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    report = Session._report  # noqa: SLF001  the last that is done for a package

    def edit_and_report(session: Session, target: Target, found: list[Diagnostic]) -> object:
        edit(package)
        return report(session, target, found)

    with monkeypatch.context() as context:
        context.setattr(Session, "_report", edit_and_report)
        assert "F401" not in runs(".")
    (package / "talker" / "talk.py").write_text(TALK)
    runs(".")
    assert runs.checked == ["talker"]


@pytest.mark.usefixtures("package")
def test_user_rules_are_not_cached(runs: Runs, tmp_path: Path) -> None:
    (tmp_path / "own" / "rules").mkdir(parents=True)
    for _ in range(2):
        runs(".", "--content", str(tmp_path / "own"))
        assert runs.checked == ["talker"]


ASKS = {"open", "listdir", "scandir", "walk", "stat", "lstat", "readlink", "access", "exists"}
ASKS |= {"lexists", "isfile", "isdir", "islink", "realpath", "getsize", "getmtime", "samefile"}
OWN_DATA = {
    *("copyright.py", "sources.py", "api.py", "renamed_codes.py"),
    *("latched.py", "released.py"),
}
"""Modules that read files of the tool itself, which counts as a whole."""

RUNS_A_PROGRAM = "xmllint.py"
"""The program is given all that it looks at."""


def _unrecorded_calls(path: Path) -> set[str]:
    """Return the calls that access the file system without recording it."""
    result: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Call):
            match node.func:
                case ast.Name(id="open"):
                    result.add("open")
                case ast.Attribute(value=ast.Name("os" | "io"), attr=name) if name in ASKS:
                    result.add(name)
                case ast.Attribute(value=ast.Attribute(ast.Name("os")), attr=name) if name in ASKS:
                    result.add(name)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names = [getattr(node, "module", None), *(alias.name for alias in node.names)]
            result |= {"pathlib", "subprocess", "glob", "shutil"}.intersection(filter(None, names))
    return result


@pytest.mark.parametrize(
    "part",
    [
        "rules",
        "scaffold/files",
        "scaffold/formats",
        "scaffold/model",
        "scaffold/ament/copyright.py",
        "scaffold/ament/copyright_diagnostics.py",
        "scaffold/ament/xml/diagnostics.py",
        "scaffold/ament/files.py",
        "scaffold/ament/cmake_diagnostics.py",
        "scaffold/ament/lint_cmake.py",
        "scaffold/ament/xml/xmllint.py",
        "scaffold/check",
        "scaffold/configuration/config.py",
    ],
)
def test_every_file_access_is_recorded(part: str) -> None:
    top = Path(__file__).resolve().parents[3] / part
    exempt = {"disk.py", "runs.py", "cache.py", RUNS_A_PROGRAM, "registry.py", "docs.py", *OWN_DATA}
    exempt |= {"overlay.py", "temporary.py"}  # what --fix and the cache write is not remembered
    exempt |= {"foreign.py"}  # it notes git's index, then asks git
    exempt |= {
        "batch.py",
        "batch_process.py",
        "on_cluster.py",
    }  # on a cluster nothing is remembered
    paths = list(top.rglob("*.py")) if top.is_dir() else [top]
    assert {p.name: a for p in paths if p.name not in exempt and (a := _unrecorded_calls(p))} == {}


@pytest.mark.parametrize("part", ["rules", "scaffold/model", "scaffold/ament"])
def test_files_of_a_package_are_read_only_through_it(part: str) -> None:
    """Otherwise the dependencies of findings are unknown; style depends only on the content."""
    top = Path(__file__).resolve().parents[3] / part
    own = {"package_files.py", "backend.py", "reference.py"}
    reads = [
        path.name
        for path in top.rglob("*.py")
        if path.name not in own and "tree.read(" in path.read_text()
    ]
    assert reads == []


def test_edit_parses_only_the_edited_file(
    runs: Runs, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = "import rclpy\n\n\ndef main():\n    rclpy.init()\n    rclpy.spin(rclpy.Node('a'))\n"
    write(package, {f"talker/node_{number}.py": node for number in range(12)})
    parsed: list[str] = []
    parse = PythonModule.parse_bytes

    def watched(path: str, data: bytes) -> PythonModule:
        parsed.append(path)
        return parse(path, data)

    monkeypatch.setattr(PythonModule, "parse_bytes", watched)
    before = runs("--select", "ND008", ".")
    assert len(parsed) > 12
    parsed.clear()
    (package / "talker" / "node_3.py").write_text(f"\n{node}")
    after = runs("--select", "ND008", ".")
    assert parsed == ["talker/node_3.py"]
    assert after == before.replace("node_3.py:6", "node_3.py:7") != before


# -- the configuration of style

STYLE_TEST = """from ament_flake8.main import main_with_errors


def test_flake8():
    rc, errors = main_with_errors(argv=['--linelength', '{}'])
    assert rc == 0
"""


def test_changed_style_configuration_is_noticed(runs: Runs, package: Path, source: Path) -> None:
    """An edit of the flake8 test alone must not check the style of other files again."""
    for number in range(12):
        (package / "talker" / f"part{number}.py").write_text(f"x = '{'x' * 110}'\n")
    test = package / "test" / "test_flake8.py"
    write(package, {"test/test_flake8.py": STYLE_TEST.format(120)})
    assert "E501" not in runs.settle(".")
    test.write_text(STYLE_TEST.format(100))
    assert runs(".").count("E501") == 12
    test.write_text("")
    assert runs(".").count("E501") == 12
    test.write_text(STYLE_TEST.format(120))
    assert "E501" not in runs(".")
    text = STYLE_TEST.replace("'--linelength', '{}'", "'--config', '../own.cfg'")
    test.write_text(text)
    assert "SC006" in runs(".")
    (source / "own.cfg").write_text("[flake8]\nextend-ignore = Q,D,I,E501\n")
    assert "SC006" not in runs(".")
    (source / "own.cfg").write_text("[flake8]\nextend-ignore = Q,D,I\n")
    assert runs(".").count("E501") == 12
    assert runs.checked == ["talker"]


# -- facts

OTHER = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Node{number}(Node):
    def __init__(self):
        super().__init__('node_{number}')
        self.declare_parameter('rate', 1.0)
        self.pub = self.create_publisher(String, 'chatter', 10)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.pub.publish(String())


def main():
    rclpy.init()
    rclpy.spin(Node{number}())
"""
LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package='talker', executable='node_{number}', parameters=[{{'rate': 2}}]),
    ])
"""
SCRIPTS = """from setuptools import setup

setup(name='talker', packages=['talker'], entry_points={{'console_scripts': {scripts}}})
"""


def write_nodes(package: Path) -> None:
    """Write nodes, and launch files that set their parameters."""
    scripts = [f"node_{number} = talker.node_{number}:main" for number in range(6)]
    files = {"setup.py": SCRIPTS.format(scripts=scripts)}
    for number in range(6):
        files[f"talker/node_{number}.py"] = OTHER.format(number=number)
        files[f"launch/node_{number}.launch.py"] = LAUNCH.format(number=number)
    write(package, files)


@pytest.fixture
def parsed(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the list of parsed files."""
    result: list[str] = []
    parse = PythonModule.parse_bytes

    def watched(path: str, data: bytes) -> PythonModule:
        result.append(path)
        return parse(path, data)

    monkeypatch.setattr(PythonModule, "parse_bytes", watched)
    return result


def test_package_rules_parse_only_edited_files(
    runs: Runs, package: Path, parsed: list[str]
) -> None:
    write_nodes(package)
    before = runs(".")
    parsed.clear()
    edited = package / "talker" / "node_3.py"
    edited.write_text(f"# a node\n{edited.read_text()}")
    assert runs(".") != before
    assert set(parsed) <= {"talker/node_3.py", "talker/__init__.py", "setup.py"}


def test_package_rules_are_not_run_again(
    runs: Runs, package: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_nodes(package)
    write(package, {"settings/node_3.yaml": "node_3:\n  ros__parameters:\n    rate: 2.0\n"})
    before = runs("--no-types", ".")
    again: set[str] = set()
    take_over = runner.Check._take_over  # noqa: SLF001

    def watched(check: runner.Check, earlier: Earlier) -> None:
        take_over(check, earlier)
        again.update(earlier.verdict.parts.keys() - check.parts.keys())

    monkeypatch.setattr(runner.Check, "_take_over", watched)
    edited = package / "talker" / "node_3.py"
    edited.write_text(f"{edited.read_text()}# a node\n")
    assert runs("--no-types", ".") == before
    assert again
    assert {key.rpartition(" ")[2] for key in again} == {"talker/node_3.py"}


def test_changed_parameter_declaration_reaches_launch_files(runs: Runs, package: Path) -> None:
    write_nodes(package)
    before = runs("--select", "PF", ".")
    edited = package / "talker" / "node_3.py"
    edited.write_text(edited.read_text().replace("'rate', 1.0", "'rate', 1"))
    after = runs("--select", "PF", ".")
    assert "launch/node_3.launch.py" in before
    assert "launch/node_3.launch.py" not in after
    assert "launch/node_2.launch.py" in after


def test_changed_import_reaches_the_program(runs: Runs, package: Path) -> None:
    helper = package / "talker" / "helper.py"
    write(
        package,
        {
            "talker/talk.py": "from rclpy.node import Node\n\nfrom talker.helper import begin\n\n\n"
            "def main():\n    begin()\n    Node('talker').get_clock()\n",
            "talker/helper.py": "def begin():\n    pass\n",
        },
    )
    before = runs("--select", "ND041", ".")
    helper.write_text("from talker.deeper import begin\n\n__all__ = ['begin']\n")
    assert runs("--select", "ND041", ".") == before
    assert "ND041" in before
    helper.write_text("import rclpy\n\n\ndef begin():\n    rclpy.init()\n")
    assert "ND041" not in runs("--select", "ND041", ".")


# -- package.xml and setup.cfg


def test_added_dependency_does_not_parse_nodes(
    runs: Runs, package: Path, parsed: list[str]
) -> None:
    write_nodes(package)
    before = runs(".")
    parsed.clear()
    manifest = MANIFEST.format("talker", "  <exec_depend>std_msgs</exec_depend>\n")
    (package / "package.xml").write_text(manifest)
    after = runs(".")
    declaring = "add <exec_depend>std_msgs</exec_depend>"
    assert declaring in before
    assert declaring not in after
    assert not [path for path in parsed if path.startswith("talker/")]


LINTED = """cmake_minimum_required(VERSION 3.8)
project(talker)
find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
ament_python_install_package(talker)
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  set(ament_cmake_flake8_MAX_LINE_LENGTH 150)
  ament_lint_auto_find_test_dependencies()
endif()
ament_package()
"""


@pytest.mark.parametrize(
    ("path", "old", "new"),
    [
        ("package.xml", "<name>talker", "<name>speaker"),
        ("package.xml", "<build_type>ament_python", "<build_type>ament_cmake"),
        ("package.xml", "</license>", "</license><buildtool_depend>catkin</buildtool_depend>"),
        ("package.xml", "</license>", "</license><test_depend>ament_lint_common</test_depend>"),
        ("package.xml", "</license>", "</license><test_depend>ament_cmake_flake8</test_depend>"),
        ("package.xml", "<description>", "<description"),
        ("setup.cfg", "lib/talker", "bin"),
        ("setup.cfg", "[install]", "[install"),
    ],
)
@pytest.mark.parametrize("build_type", ["ament_python", "ament_cmake"])
def test_edited_manifest_gives_the_report_of_a_first_run(
    runs: Runs,
    source: Path,
    build_type: str,
    path: str,
    old: str,
    new: str,
) -> None:
    talker, caller = make_package(source, "talker"), make_package(source, "caller")
    write_nodes(talker)
    write(caller, {f"launch/{at}.launch.py": LAUNCH.format(number=at) for at in range(4)})
    for number in range(3):
        (talker / "talker" / f"part{number}.py").write_text(f"x = '{'x' * 110}'\n")
    if build_type == "ament_cmake":
        write(talker, {"CMakeLists.txt": LINTED})
        manifest = talker / "package.xml"
        manifest.write_text(manifest.read_text().replace("ament_python", build_type))
    text = (talker / path).read_text()
    for changed in (text.replace(old, new), text):
        runs.settle(".")
        (talker / path).write_text(changed)
        reported = runs(".")
        assert runs.first(".") == reported


# -- several distributions


def test_check_for_several_distributions_is_cached(runs: Runs, source: Path, package: Path) -> None:
    make_package(source, "listener")
    words = (".", "--distro", "jazzy,lyrical", "--no-types")
    first = runs(*words)
    assert sorted(runs.checked) == ["listener", "listener", "talker", "talker"]
    assert runs(*words) == first
    assert runs.checked == []
    (package / "talker" / "talk.py").write_text("class A:\n    def f(self):\n        pass\n")
    assert "CNL100" in runs(*words)
    assert runs.checked == ["talker", "talker"]
    runs(".", "--distro", "lyrical", "--no-types")
    runs(*words, "--ignore", "CNL100")
    assert "CNL100" in runs(*words)
    assert runs.checked == []
