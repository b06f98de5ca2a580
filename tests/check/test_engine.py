"""Registry, runner, selection and suppression."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar

import pytest

from scaffold.ament.codes import CODES
from scaffold.check import runner, selection, suppression
from scaffold.check.fixes.fixer import splice
from scaffold.check.rules import registry
from scaffold.check.rules.renamed_codes import renamed_codes
from scaffold.check.rules.rule import Example, Rule
from scaffold.check.selection import Selection, area_prefixes
from scaffold.check.session import Session, all_rules
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.edits import Edit
from scaffold.errors import ConfigError, ContentError
from scaffold.files.tree import MemoryTree
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package
from scaffold.model.workspace.workspace import Workspace
from scaffold.source import Location, MissingFileError

RULE = '''\
"""A rule."""

from scaffold.api import Example, Rule


class {name}(Rule):
    """Flaw."""

    code = "{code}"
    name = "{rule}"
    examples = ()

    def check(self, package):
        yield from ()
'''


def write_rule(root: Path, file: str, code: str, rule: str) -> None:
    path = root / "cmake" / f"{file}.py"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(RULE.format(name="Some", code=code, rule=rule))


class Loud(Rule):
    """Reports the first line of CMakeLists.txt."""

    code = "CM900"
    name = "loud"
    examples: ClassVar[tuple[Example, ...]] = ()

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield self.report(package.start_of("CMakeLists.txt"), "loud")


class Crashing(Loud):
    """Raises after its first diagnostic."""

    code = "CM901"

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield self.report(package.start_of("CMakeLists.txt"), "before the crash")
        raise ZeroDivisionError("by zero")


class ReadsNotesOfListener(Rule):
    code = "CM903"
    name = "reads-notes"

    def check(self, package: Package) -> Iterator[Diagnostic]:
        listener = package.workspace.get("listener") if package.name == "talker" else None
        if listener is not None:
            listener.source("notes.txt")
        yield from ()


class NeedsManifest(Loud):
    """Reads package.xml."""

    code = "CM902"

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield self.report(package.manifest.root, "never")


def test_registry_finds_rules(tmp_path: Path) -> None:
    write_rule(tmp_path, "some_flaw", "CM001", "some-flaw")
    write_rule(tmp_path, "_helper", "CM009", "ignored")
    assert [rule.code for rule in registry.load([str(tmp_path)])] == ["CM001"]


@pytest.mark.parametrize(
    ("file", "code", "rule", "message"),
    [
        ("other_name", "CM002", "some-flaw", "file and rule share one name"),
        ("second_flaw", "CM001", "second-flaw", "CM001 second-flaw is taken by"),
        ("broken", "CM003", '" + 1 + "', "TypeError"),
    ],
)
def test_registry_rejects_invalid_rules(
    tmp_path: Path, file: str, code: str, rule: str, message: str
) -> None:
    write_rule(tmp_path, "first_flaw", "CM001", "first-flaw")
    write_rule(tmp_path, file, code, rule)
    with pytest.raises(ContentError, match=message):
        registry.load([str(tmp_path)])


def test_roots_may_have_equal_file_names(tmp_path: Path) -> None:
    write_rule(tmp_path / "a", "flaw_a", "CM001", "flaw-a")
    write_rule(tmp_path / "b", "flaw_b", "CM002", "flaw-b")
    (tmp_path / "a" / "cmake" / "flaw_c.py").write_text(
        RULE.format(name="C", code="CM003", rule="flaw-c")
    )
    rules = registry.load([str(tmp_path / "a"), str(tmp_path / "b")])
    assert [rule.code for rule in rules] == ["CM001", "CM002", "CM003"]


def test_area_may_have_subdirectories(tmp_path: Path) -> None:
    write_rule(tmp_path, "flaw_a", "CM001", "flaw-a")
    area = tmp_path / "cmake"
    (area / "install").mkdir()
    (area / "install" / "_names.py").write_text("CODE = 'CM002'\n")
    (area / "install" / "flaw_b.py").write_text(
        "from ._names import CODE\n"
        + RULE.format(name="B", code="CM002", rule="flaw-b").replace('"CM002"', "CODE")
    )
    rules = registry.load([str(tmp_path)])
    assert [rule.code for rule in rules] == ["CM001", "CM002"]
    assert area_prefixes(rules) == {"cmake": "CM"}


def test_crash_is_a_diagnostic_and_other_rules_run() -> None:
    diagnostics = runner.check(Package.of({"CMakeLists.txt": ""}), [Crashing(), Loud()])
    assert [d.code for d in diagnostics] == ["CM900", "CM901", "SC002"]
    assert "CM901 loud failed: ZeroDivisionError: by zero" in diagnostics[-1].message


def test_rule_is_silent_about_a_missing_file() -> None:
    package = Package.of({"CMakeLists.txt": ""})
    assert runner.check(package, [NeedsManifest()]) == []
    with pytest.raises(MissingFileError):
        _ = package.manifest


@pytest.mark.parametrize("order", [("talker", "listener"), ("listener", "talker")])
def test_unreadable_file_of_another_package_is_not_reported(order: tuple[str, str]) -> None:
    workspace = Workspace[Package]()
    notes = {"listener": b"\xff", "talker": b"heard\n"}
    packages: dict[str, Package] = {}
    for name, data in notes.items():
        files: dict[str, str | bytes] = {
            "package.xml": f"<package><name>{name}</name></package>\n",
            "notes.txt": data,
        }
        packages[name] = Package(MemoryTree(files), directory=name, workspace=workspace)
        workspace.add(packages[name])
    session = Session([ReadsNotesOfListener], Selection(select=("CM",)))
    results = session.run_batch([Target(packages[name]) for name in order])
    assert [item.diagnostics for item in results] == [[], []]


def test_unparsable_file_is_reported_once() -> None:
    package = Package.of({"package.xml": "<package>\n<name>x</nam>\n"})
    diagnostics = runner.check(package, [NeedsManifest(), NeedsManifest()])
    assert [(d.code, d.location.path, d.location.line) for d in diagnostics] == [
        ("SC001", "package.xml", 2)
    ]


@pytest.mark.parametrize(
    ("path", "severity"),
    [
        ("CMakeLists.txt", Severity.WARNING),
        ("talker.hpp", Severity.WARNING),
        ("a.msg", Severity.ERROR),
    ],
)
def test_undecodable_bytes_are_an_error_only_where_they_matter(
    path: str, severity: Severity
) -> None:
    class NeedsFile(NeedsManifest):
        def check(self, package: Package) -> Iterator[Diagnostic]:
            package.source(path)
            return iter(())

    diagnostics = runner.check(Package.of({path: b"# \xb2\xe2\xca\xd4\n"}), [NeedsFile()])
    assert [(item.code, item.severity) for item in diagnostics] == [("SC001", severity)]


@pytest.mark.parametrize(
    ("select", "ignore", "code", "wanted"),
    [
        ((), (), "CM001", True),
        (("CM",), (), "CM001", True),
        (("CM",), (), "E501", False),
        ((), ("CM",), "CM001", False),
        (("CM001",), ("CM",), "CM001", True),
        (("CM",), ("CM001",), "CM001", False),
        (("E",), ("E",), "E501", False),
        (("CM",), (), "SC001", True),
        (("CM",), (), "SC003", False),
        (("CM",), ("SC001",), "SC001", False),
    ],
)
def test_selected_and_ignored_codes(
    select: tuple[str, ...], ignore: tuple[str, ...], code: str, *, wanted: bool
) -> None:
    assert Selection(select, ignore).wants(code) is wanted


def test_unknown_code_is_rejected_with_a_suggestion() -> None:
    with pytest.raises(ConfigError, match=r"--select: no rule has the code 'CN001'.*CM001"):
        selection.resolve(["PX", "CN001"], {"CM001": "a-name", "PX001": "b-name"}, {}, "--select")


@pytest.mark.parametrize(
    ("prefix", "new"), [("NM041", "IM041$"), ("NM04", "IM041, IM042, IM043, IM044, IM045$")]
)
def test_former_code_is_rejected_with_the_new_one(prefix: str, new: str) -> None:
    with pytest.raises(ConfigError, match=f"--select: .*{prefix!r}; renamed to {new}"):
        selection.resolve([prefix], {"CM001": "a", "IM041": "b", "NM001": "c"}, {}, "--select")


def test_suppression_by_a_former_code_is_reported() -> None:
    package = Package.of({"a.py": "import a  # noqa: NM041\n"})
    (unused,) = suppression.apply(package, [], {"IM041"})
    assert unused.message == "noqa: NM041 suppresses nothing: renamed to IM041"


def test_former_codes_are_unused_and_map_to_rules() -> None:
    codes = {rule.code for rule in all_rules(registry.load(content.roots("rules")))} | set(CODES)
    assert not renamed_codes().keys() & codes
    assert set(renamed_codes().values()) <= codes


@pytest.mark.parametrize(
    ("comment", "left"),
    [
        ("# noqa: CM900", []),
        ("# NOQA:CM900", []),
        ("# noqa: cm900", []),
        ("# noqa: CM123, CM900", []),
        ("# noqa: CM123 CM900  because", []),
        ("# noqa", []),
        ("# noqa because", []),
        ("<!-- noqa: CM900 -->", []),
        ("# noqa: CM123", ["CM900"]),
        ("# noqa: CM90", ["CM900"]),
        ("# noqas", ["CM900"]),
        ("noqa: CM900", ["CM900"]),
        ("\n# noqa: CM900", ["CM900", "SC003"]),
        ("\n# NOQA: cm900", ["CM900", "SC003"]),
        ("\n# noqa", ["CM900"]),
        ("\n# noqa: CM123", ["CM900"]),
    ],
)
def test_suppression_on_the_same_line(comment: str, left: list[str]) -> None:
    package = Package.of({"CMakeLists.txt": f"project(x)  {comment}\n"})
    kept = suppression.apply(package, runner.check(package, [Loud()]), {"CM900"})
    assert [diagnostic.code for diagnostic in kept] == left


def test_noqa_in_a_file_without_comments_is_ignored() -> None:
    package = Package.of({"CMakeLists.txt": "", "notes.md": "# noqa: CM900\n"})
    assert suppression.apply(package, [], {"CM900"}) == []


def test_finding_after_the_end_of_the_file_is_kept() -> None:
    package = Package.of({"CMakeLists.txt": "# noqa\n"})
    diagnostics = [Loud().report(Location("CMakeLists.txt", 9, 1, 9, 1), "behind the end")]
    assert suppression.apply(package, diagnostics, set()) == diagnostics


def test_unused_suppression_is_reported_at_its_place() -> None:
    text = "project(x)\nset(a b)  # noqa: CM900, CM123\n"
    package = Package.of({"CMakeLists.txt": text})
    kept = suppression.apply(package, runner.check(package, [Loud()]), {"CM900"})
    assert [(d.code, d.location.line, d.location.column) for d in kept] == [
        ("CM900", 1, 1),
        ("SC003", 2, 19),
    ]


def test_edits_are_spliced() -> None:
    edits = [Edit("f", 4, 4, "X"), Edit("f", 0, 1, "")]
    assert splice("abcdef", edits) == "bcdXef"


def test_python_rule_works_with_a_broken_cmakelists() -> None:
    (rule,) = (item for item in registry.load(content.roots("rules")) if item.code == "PX020")
    package = Package.of(
        {
            "package.xml": "<package><name>talker</name></package>\n",
            "CMakeLists.txt": "project(talker",
            "talker/__init__.py": "import rclpy\n",
        }
    )
    diagnostics = runner.check(package, [rule()])
    assert [item.location.path for item in diagnostics if item.code == "PX020"] == [
        "talker/__init__.py"
    ]
