"""The verdict for each distribution of ROS 2, and for several at once."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from scaffold import changes, distributions
from scaffold.check.result import Result
from scaffold.check.several import merged
from scaffold.cli import distro
from scaffold.cli.main import main
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.distributions import NAMES, ORDER, named, nearest
from scaffold.edits import Edit, Fix
from scaffold.model.manifest import conditions
from scaffold.model.package import Package
from scaffold.model.rclpy.api import names_of
from scaffold.model.workspace.definitions import definitions_for
from scaffold.source import Location
from scaffold.types.stubs.libraries import library_stubs
from scripts import bundle_distribution

ROOT = Path(__file__).parent.parent
DATA = ROOT / "scaffold" / "data"
_MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>talker</name>
  <version>0.0.0</version>
  <description>Says something</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>rclpy</exec_depend>
  <exec_depend>geometry_msgs</exec_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
Found = list[tuple[str, str, list[str]]]


def write(directory: Path, code: str) -> Path:
    """Write a package with one module."""
    package = directory / "talker"
    (package / "talker").mkdir(parents=True)
    (package / "package.xml").write_text(_MANIFEST)
    (package / "talker" / "__init__.py").write_text("")
    (package / "talker" / "node.py").write_text(code)
    return package


def check(
    capsys: pytest.CaptureFixture[str], package: Path, distro: str, select: str = "ND,TY,MS,SC"
) -> Found:
    """Return code, message and distributions of each finding."""
    main(["check", str(package), "--distro", distro, "--format", "json", "--select", select])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    return [(item["code"], item["message"], item["distributions"]) for item in findings]


NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.get_logger().{}('hello')\n"
)


def test_unknown_distribution_is_rejected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = write(tmp_path, "")
    for words, message in (
        ("lyrcal", "no distribution 'lyrcal'; did you mean 'lyrical'?"),
        ("noetic", "'noetic' is a ROS 1 distribution; choose from humble,"),
        ("iron", "'iron' has reached its end of life; choose from humble,"),
        ("jazzy lyrical", "is more than one distribution; separate them with commas"),
        (",", "no distribution is given"),
    ):
        assert main(["check", str(package), "--distro", words]) == 2
        assert message in capsys.readouterr().err


def test_distro_flag_can_be_repeated(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    package = write(tmp_path, "")
    main(["check", str(package), "--select", "ND", "--distro", "lyrical,jazzy", "--distro=humble"])
    assert " for Humble, Jazzy and Lyrical: " in capsys.readouterr().out


def test_removed_method_is_reported_for_later_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = write(tmp_path, NODE.format("warn"))
    assert check(capsys, package, "jazzy") == []
    (finding,) = check(capsys, package, "lyrical")
    assert ".warn was removed in Lyrical" in finding[1]
    assert finding[2] == ["lyrical"]
    (same,) = check(capsys, package, "rolling")
    assert same[2] == ["rolling"]


def test_several_distributions_report_each_finding_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code = NODE.format("warn") + "        self.get_logger().shout('hello')\n"
    package = write(tmp_path, code)
    result = {
        re.findall(r"[.'](warn|shout)\b", item[1])[0]: item[2]
        for item in check(capsys, package, "lyrical,jazzy")
    }
    assert result == {"warn": ["lyrical"], "shout": ["jazzy", "lyrical"]}
    main(["check", str(package), "--distro", "jazzy,lyrical", "--select", "ND,TY"])
    *lines, summary = capsys.readouterr().out.splitlines()
    assert sum("(lyrical)" in line for line in lines) == 1
    assert sum("(jazzy, lyrical)" in line for line in lines) == 1
    assert summary.startswith("1 package, 3 files for Jazzy and Lyrical: ")


def test_finding_names_all_affected_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = write(tmp_path, "import imp\nimport rclpy\nimport rclpy.nodes\n")
    old, new = sorted(check(capsys, package, "humble,jazzy,kilted,lyrical", "TY001"))
    assert old[1].startswith("Python 3.12/3.14 has no module 'imp'")
    assert new[1].startswith("ROS 2 Humble/Jazzy/Kilted/Lyrical has no module 'rclpy.nodes'")
    (alone,) = [item for item in check(capsys, package, "lyrical", "TY001") if "imp'" in item[1]]
    assert alone[1].startswith("Python 3.14 has no module 'imp'")


def test_fallback_import_for_older_distributions_is_accepted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    older = "from ros2param.api import get_parameter_value\n"
    assert len(check(capsys, write(tmp_path / "a", older), "jazzy", "IM050")) == 1
    newer = "    from rclpy.parameter import get_parameter_value\n"
    code = f"try:\n{newer}except ImportError:\n    {older}"
    assert check(capsys, write(tmp_path / "b", code), "jazzy", "IM050") == []


def test_name_added_later_is_reported_for_earlier_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = write(
        tmp_path, "import rclpy\n\n\ndef main():\n    with rclpy.init():\n        pass\n"
    )
    findings = {
        name: [code for code, *_ in check(capsys, package, name, "ND005")] for name in ORDER
    }
    assert findings == {"humble": ["ND005"], "jazzy": ["ND005"], "kilted": [], "lyrical": []}


def test_arguments_depend_on_the_target(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code = NODE.format("info").replace("'talker'", "'talker', enable_logger_service=True")
    package = write(tmp_path, code)
    (finding,) = check(capsys, package, "humble")
    assert "enable_logger_service" in finding[1]
    assert check(capsys, package, "jazzy") == []


def test_message_types_depend_on_the_target(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = write(tmp_path, "from geometry_msgs.msg import Pose2D\n\npose = Pose2D()\n")
    assert check(capsys, package, "kilted") == []
    (finding,) = check(capsys, package, "lyrical")
    assert finding[0] == "TY002"


def test_python_syntax_depends_on_the_target(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code = "def run(work):\n    try:\n        work()\n    except* ValueError:\n        pass\n"
    package = write(tmp_path, code)
    (finding,) = check(capsys, package, "humble", "SC,E9")
    assert "3.11" in finding[1]
    assert check(capsys, package, "jazzy", "E9") == []


def test_sourced_shell_of_another_distribution_is_noted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    package = write(tmp_path, "")
    monkeypatch.setenv("ROS_DISTRO", "humble")
    main(["check", str(package), "--select", "ND"])
    note, summary = capsys.readouterr().out.splitlines()
    assert note == (
        "checked for Jazzy, although ROS_DISTRO is 'humble'; use --distro humble to check for that"
    )
    assert " for Jazzy: " in summary
    main(["check", str(package), "--select", "ND", "--distro", "humble"])
    assert "ROS_DISTRO" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("path", "text", "expected"),
    [
        (
            "README.md",
            "Tested with ROS 2 Humble + Nav2\n",
            "README.md is for Humble; use --distro humble",
        ),
        (
            "docker/Dockerfile.robot",
            "FROM ros:humble-ros-base\nENV ROS_DISTRO=rolling\n",
            "docker/Dockerfile.robot is for Humble and Rolling; use --distro humble,rolling",
        ),
        (
            "README.md",
            "sudo apt install ros-foxy-desktop\n",
            "README.md is for Foxy, which has reached its end of life",
        ),
        ("README.md", "ROS 2 Humble or later\n", ""),
        ("README.md", "ROS 2 Humble, ROS 2 Jazzy\n", ""),
        ("README.md", "Heroshumble ROS Ironclad, see the ROS 2 documentation\n", ""),
    ],
)
def test_readme_or_workflow_of_another_distribution_is_noted(
    path: str,
    text: str,
    expected: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".git").mkdir()
    package = write(tmp_path, "")
    (tmp_path / path).parent.mkdir(exist_ok=True)
    (tmp_path / path).write_text(text)
    for _ in range(2):  # the second report is a remembered one
        main(["check", str(package), "--select", "ND"])
        *notes, _summary = capsys.readouterr().out.splitlines()
        assert [note.removesuffix(" to check for that") for note in notes] == (
            [f"checked for Jazzy, although {expected}"] if expected else []
        )
    main(["check", str(package), "--select", "ND", "--distro", "jazzy"])
    assert "although" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("shell", "expected"),
    [
        ("", ()),
        ("jazzy", ()),
        ("humble", ("observed on Jazzy, although ROS_DISTRO is 'humble'",)),
        (
            "noetic",
            ("observed on Jazzy, although ROS_DISTRO is 'noetic', which is a ROS 1 distribution",),
        ),
    ],
)
def test_smoke_notes_a_sourced_shell_of_another_distribution(
    shell: str, expected: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DISTRO", shell)
    assert distro.note_of_smoke("jazzy") == expected


def test_configuration_sets_targets(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, NODE.format("warn"))
    (tmp_path / "ros2-scaffold.toml").write_text('[check]\ndistribution = ["jazzy", "lyrical"]\n')
    monkeypatch.chdir(tmp_path)
    assert main(["check", "--select", "ND,TY"]) == 1
    assert "(lyrical)" in capsys.readouterr().out
    assert main(["check", "--select", "ND,TY", "--distro", "jazzy"]) == 0
    assert main(["check", "--select", "ND,TY", "--add-noqa"]) == 2
    assert "--add-noqa works for one distribution at a time" in capsys.readouterr().err


def test_since_works_with_several_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    package = write(tmp_path, NODE.format("shout"))
    git = ["git", "-C", str(tmp_path), "-c", "user.name=Ada", "-c", "user.email=ada@example.org"]
    for command in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "Talk"]):
        subprocess.run([*git, *command], check=True)
    (package / "talker" / "other.py").write_text(NODE.format("warn"))
    monkeypatch.chdir(tmp_path)
    arguments = ["--select", "ND,TY", "--since", "HEAD", "--distro", "jazzy,lyrical"]
    assert main(["check", *arguments]) == 1
    printed = capsys.readouterr().out
    assert "other.py:8" in printed
    assert "node.py:8" not in printed
    assert "since HEAD: 1 changed file; 1 older finding in other files hidden" in printed


def test_standard_input_is_checked_and_fixed_for_several_distributions(tmp_path: Path) -> None:
    package = write(tmp_path, "")
    command = [sys.executable, "-m", "scaffold", "check", "--select", "IM,ND,TY"]
    command += ["--distro", "jazzy,lyrical", "--stdin-filename", str(package / "talker/node.py")]
    text = NODE.format("warn")
    result = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert "node.py:8:9: error" in result.stdout
    assert "(lyrical)" in result.stdout
    fixed = subprocess.run(
        [*command, "--fix"], input=text, capture_output=True, text=True, check=False
    )
    assert fixed.stdout == NODE.format("warning")
    assert fixed.returncode == 0


def test_cached_results_depend_on_the_target(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path, NODE.format("warn"))
    monkeypatch.chdir(tmp_path)
    configuration = tmp_path / "ros2-scaffold.toml"
    codes = []
    for name in ("jazzy", "lyrical", "jazzy"):
        configuration.write_text(f"[check]\ndistribution = {name!r}\n")
        codes.append(main(["check", "--select", "ND,TY"]))
    assert codes == [0, 1, 0]
    capsys.readouterr()


def test_fixes_are_valid_for_all_given_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = write(tmp_path, NODE.format("warn").replace("'hello'", '"hello", [1,]'))
    module = package / "talker" / "node.py"
    words = ["check", str(package), "--distro", "humble,lyrical", "--select", "IM,Q,E2,CNL"]
    before = module.read_text()
    assert main([*words, "--fix", "--diff"]) == 1
    out = capsys.readouterr()
    assert "+        self.get_logger().warning('hello', [1,])" in out.out
    assert module.read_text() == before
    assert main([*words, "--fix"]) == 1
    # Humble alone wants a blank after the comma, and Lyrical's linters would report that.
    assert module.read_text() == before.replace("warn", "warning").replace('"', "'")
    report = capsys.readouterr()
    assert "2 fixes applied" in report.err
    assert "E231" in report.out
    written = module.read_text()
    assert main([*words, "--fix"]) == 1
    assert module.read_text() == written


def test_conflicting_import_orders_follow_the_oldest_distribution(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "import os\nimport imp\n\nimport rclpy\n\nprint(imp, os, rclpy)\n"
    package = write(tmp_path, text)
    module = package / "talker" / "node.py"
    words = ["check", str(package), "--distro", "humble,lyrical", "--select", "I1,I2,TY001"]
    assert main(words) == 1
    assert "1 fixable with --fix" in capsys.readouterr().out
    for count in (1, 0):
        assert main([*words, "--fix"]) == 1
        report = capsys.readouterr()
        assert re.search(rf"^{count} fix(es)? applied", report.err)
        assert "has no module 'imp'" in report.out
        assert "fixable" not in report.out
        assert module.read_text() == text.replace("import os\nimport imp", "import imp\nimport os")
    assert main(["check", str(package), "--distro", "lyrical", "--select", "I1,I2"]) == 1
    assert "third-party" in capsys.readouterr().out


def test_fix_is_offered_only_if_valid_for_all_distributions() -> None:
    package = Package.of({"package.xml": "<package/>"})
    at = Location.start_of("package.xml")
    fix = Fix("write it", (Edit("package.xml", 0, 0, " "),))
    entry, both, always = (
        Diagnostic(code, "rule", Severity.ERROR, at, "wrong", fix)
        for code in ("AA001", "AA002", "AA003")
    )
    actual = {
        named("humble"): [Result(package, 0, [both])],
        named("lyrical"): [Result(package, 0, [entry, both, always])],
    }
    (result,) = merged(actual, {"AA003"})
    offered = {item.code: item.fix is not None for item in result.diagnostics}
    assert offered == {"AA001": False, "AA002": True, "AA003": True}


def test_manifest_conditions_depend_on_the_target() -> None:
    with distributions.targeting(named("humble")):
        assert conditions.holds("$ROS_DISTRO == humble")
    assert not conditions.holds("$ROS_DISTRO == humble")


@pytest.mark.parametrize("name", NAMES)
def test_each_distribution_has_its_data(name: str) -> None:
    item = named(name)
    assert item.python >= (3, 10)
    assert item.fact("build.package_may_be_installed_twice") in {True, False}
    assert "create_publisher()" in names_of(item)["rclpy.node.Node"]
    assert "rclpy/node.pyi" in library_stubs(item)
    with distributions.targeting(item):
        definition = definitions_for(prefixes=()).find("std_msgs/msg/Header")
    assert definition is not None


def test_no_code_compares_distribution_names() -> None:
    exempt = "(?<!distro=)(?<!moved_from=)(?<!did you mean )"  # examples of rules
    name = "|".join(NAMES)
    pattern = re.compile(rf"""{exempt}(?:"(?:{name})"|'(?:{name})')""")
    asking = {
        str(path.relative_to(ROOT)): result
        for top in ("rules", "scaffold", "templates")
        for path in sorted((ROOT / top).rglob("*"))
        if path.suffix in {".py", ".yaml", ".jinja"}
        and (result := pattern.findall(path.read_text()))
    }
    assert asking == {"scaffold/distributions.py": ['"rolling"', '"jazzy"']}


def test_distribution_without_data_maps_to_the_nearest() -> None:
    result = {name: nearest(name).name for name in ("foxy", "iron", "kilted", "rolling", "mellow")}
    expected = {"foxy": "humble", "iron": "jazzy", "kilted": "kilted", "rolling": "rolling"}
    assert result == {**expected, "mellow": ORDER[-1]}


def test_new_distribution_copies_facts_of_the_previous_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ORDER:
        (tmp_path / name).mkdir()
        for file in (DATA / name).glob("*.*"):
            (tmp_path / name / file.name).write_bytes(file.read_bytes())
    (tmp_path / "mellow").mkdir()
    monkeypatch.setattr(bundle_distribution, "DATA", tmp_path)
    copied = [*bundle_distribution.with_facts("mellow")]
    assert copied == ["profile.toml", "standard_library.txt"]
    for file_name in copied:
        before = (DATA / ORDER[-1] / file_name).read_text()
        assert (tmp_path / "mellow" / file_name).read_text() == before
    assert [*bundle_distribution.with_facts("mellow")] == []


def test_pages_are_up_to_date(tmp_path: Path) -> None:
    script = ROOT / "scripts" / "document_distributions.py"
    subprocess.run([sys.executable, str(script), str(tmp_path)], check=True, cwd=ROOT)
    pages = {file.name: file.read_text() for file in tmp_path.iterdir()}
    stored = {file.name: file.read_text() for file in (ROOT / "docs" / "distributions").iterdir()}
    assert pages == stored, "`make docs`"


def test_the_data_of_all_distributions_is_small() -> None:
    others = sum(
        file.stat().st_size
        for name in ORDER
        if name != distributions.DEFAULT
        for file in (DATA / name).rglob("*")
        if file.is_file()
    )
    assert others < 3_000_000


@pytest.mark.parametrize("name", ORDER)
def test_removed_interface_packages_are_listed_as_removed(name: str) -> None:
    """Packages bundled with an older distribution but not with this one are in the removals."""
    target = named(name)
    older = [item for item in map(named, ORDER) if item.place < target.place]
    gone = {package for item in older for package in _bundled(item)} - _bundled(target)
    with distributions.targeting(target):
        assert [package for package in gone if changes.removed_package(package) is None] == []


def _bundled(distribution: distributions.Distribution) -> set[str]:
    text = Path(distribution.path("interfaces.txt")).read_text(encoding="utf-8")
    return {line.split()[1] for line in text.splitlines() if line.startswith("@ ")}
