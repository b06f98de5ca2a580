"""Style follows the configuration that the tests of a package pass to ament."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold.ament import StyleCheck
from scaffold.ament.settings import settings_of
from scaffold.check.adjustments import runs_linter
from scaffold.diagnostic import Diagnostic
from scaffold.model.package import Package
from tests import oracles
from tests.ament import style_cases

Found = set[tuple[str, int, str]]

MANIFEST = "<package format='3'><name>a</name><test_depend>{}</test_depend></package>\n"
ONLY_FLAKE8 = "ament_pep257(--select D999)\n"
"""pep257 runs, and reports nothing."""


def check(package: Package, *, is_reference: bool = False) -> list[Diagnostic]:
    return StyleCheck([package], is_reference=is_reference).diagnostics(package)


def findings(diagnostics: list[Diagnostic]) -> Found:
    return {(d.location.path, d.location.line, d.code) for d in diagnostics}


def written(directory: Path, files: Mapping[str, str]) -> Package:
    for path, text in files.items():
        (directory / path).parent.mkdir(parents=True, exist_ok=True)
        (directory / path).write_text(text)
    return Package.at(directory)


MORE_CASES = (
    "def f(a):\n    def g():\n        pass\n    return [\n      a,\n        g]\n",
    (
        "class A:\n    class B:\n        pass\n\n    def __init__(self):\n        pass\n\n"
        "    def __str__(self):\n        return ''\n\n    def m(self): return 1\n"
    ),
    '"""This is it."""\n\n\nclass A:\n    """\n    Do it.\n\n    More.\n    """\n\n    x = 1\n',
    "x = (1\n     + 2 *\n     3)\ny = x*2-1 **2\nz = {1:  2,\t3: 4}\n",
    "if (a and\n    b):\n    pass\n",
    "x = foo(\n    1,\n    )\ny = foo(\n  1\n)\nz = foo(\n        1\n)\n",
    (
        "# a comment that is longer than sixty characters, for those who count them\n"
        "# https://example.com/a/very/long/address/that/nobody/can/break/into/two/parts/at/all\n"
        "def f(a):\n    '''Text that is longer than sixty characters is in here, somewhere.'''\n"
        "    if a:\n        for b in a:\n            try:\n                pass\n"
        "            finally:\n                pass\n    with a:\n"
        "        while a:\n            a = b\n"
    ),
    (
        "import os\nimport rclpy\nfrom launch_ros import actions\n"
        "from launch import conditions, Action\n"
        "import abc\n\nfrom . import mine\nfrom rclpy.node import Node, QoS\n"
    ),
    (
        "from rclpy import z, A, b\nimport std_msgs.msg\n\nimport std_srvs\n"
        "from os import path, R_OK\n"
    ),
    "x = \"a\" + 'b' + '''c''' + f\"{x!r} 'y'\" + 'it\\'s' + \"say \\\"x\\\"\"\n",
    "def f(id, my):\n    undefined\n    other\n    type = my = 1\n    return type  # noqa: F841\n",
    'x = "a"  # foo noqa\ny = "b"  # noqa\nimport os  # noqa\n',
    "import os\nimport abc  # noqa: I100\nimport _ast  # noqa: I1\n",
    (
        "import pytest\n\n\n@pytest.fixture\ndef given():\n    '''Returns it'''\n\n\n"
        "@property\ndef p(self):\n    '''Returns it.'''\n"
    ),
)
"""Code about which configurations disagree."""

CONFIGURATIONS = {
    "line lengths": "max-line-length = 60\nmax-doc-length = 50\nselect = E5,W5",
    "ignore replaces the defaults": "ignore = Q",
    "everything": "ignore = X9\nmax-complexity = 3\nmax-doc-length = 60",
    "select and extend": "select = E1,D2,I,Q\nextend-ignore = D20,I2\nextend-select = D203,W50",
    "numpy": "docstring-convention = numpy\nimport-order-style = pycharm",
    "google": "docstring-convention = google\nimport-order-style = smarkets",
    "all docstrings": "docstring-convention = all\nextend-ignore = D4\nimport-order-style = pep8",
    "edited": "import-order-style = edited\napplication-import-names = rclpy\n"
    "application-package-names = std_msgs, launch",
    "appnexus": "import-order-style = appnexus\napplication-import-names = rclpy.node\n"
    "application-package-names = launch_ros",
    "cryptography": "application-import-names = rclpy, launch.actions\nindent-size = 2",
    "hanging": "hang-closing = true\nignore =\nselect = E1\nindent_size = 3",
    "double quotes": "inline-quotes = double\nmultiline-quotes = '\ndocstring-quotes = '''",
    "old name of quotes": 'quotes = "\navoid-escape = no\ncheck-inside-f-strings = true',
    "builtins": "builtins = undefined, my\nbuiltins-ignorelist = id\ndisable-noqa = true",
    "decorators": "ignore-decorators = pytest\nproperty-decorators = given\n"
    "ignore-self-only-init = true\ncheck-inside-f-strings = true",
    "per file": "per-file-ignores =\n    case_000*.py: D,Q000\n    ./sub/*.py: I, W\n"
    "    sub/case_0003.py:E,F",
    "exclude": "exclude = case_0001.py,sub/case_000*\nextend-exclude = case_0004.py",
    "file names": "filename = */case_0002.py",
    "empty": "",
}


@pytest.mark.parametrize("options", CONFIGURATIONS.values(), ids=CONFIGURATIONS)
def test_same_findings_with_a_configuration(tmp_path: Path, options: str) -> None:
    cases = [*MORE_CASES, *style_cases.IMPORTS[:20], *style_cases.CONTINUATION_LINES[:40]]
    cases += [style_cases.DOCSTRING_PLACES[0].format(body) for body in style_cases.DOCSTRINGS[:40]]
    files = {
        f"{'sub/' if at % 3 == 1 else ''}case_{at:04}.py": item for at, item in enumerate(cases)
    }
    package = written(
        tmp_path / "a",
        {
            **files,
            "../own.cfg": f"[flake8]\n{options}\n",
            "CMakeLists.txt": f"project(a)\nament_flake8(CONFIG_FILE ../own.cfg)\n{ONLY_FLAKE8}",
        },
    )
    own, real = (
        findings(check(package)),
        {tuple(item) for item in oracles.ament_flake8(tmp_path / "a", "--config", "../own.cfg")},
    )
    assert (sorted(real - own), sorted(own - real)) == ([], [])


@pytest.mark.parametrize(
    ("options", "paths"),
    [
        ("--select D1 D4", ""),
        ("--ignore D2,D4", ""),
        ("--convention numpy", ""),
        ("--add-select D203 --add-ignore D400 D415", ""),
        ("--exclude sub/case_0001.py case_0002.py", "sub case_0002.py case_0004.py"),
    ],
)
def test_same_docstrings_with_arguments(tmp_path: Path, options: str, paths: str) -> None:
    files = {
        f"{'sub/' if at % 2 else ''}case_{at:04}.py": item for at, item in enumerate(MORE_CASES)
    }
    cmake = f"project(a)\nament_flake8(none.py)\nament_pep257({paths} {options})\n"
    package = written(tmp_path, {**files, "none.py": "", "CMakeLists.txt": cmake})
    places = paths.split() or ["."]
    result = oracles.ament_pep257(tmp_path, *options.split(), paths=places)
    own, real = findings(check(package)), {tuple(item) for item in result}
    assert (sorted(real - own), sorted(own - real)) == ([], [])


# -- how a configuration gets to ament

LONG = f"x = '{'x' * 110}'\n"
QUOTED = 'x = "x"\n'
TEST = """import os
import pathlib
from pathlib import Path
from ament_flake8.main import main_with_errors

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = Path(__file__).resolve().parents[1]


def test_flake8():
    rc, errors = main_with_errors({})
    assert rc == 0
"""


def flake8_codes(tmp_path: Path, files: Mapping[str, str]) -> dict[str, set[str]]:
    """Return the codes of flake8 that are reported, by file."""
    shown = {"long.py": LONG, "quoted.py": QUOTED, "sub/quoted.py": QUOTED}
    package = written(
        tmp_path / "a", {"package.xml": MANIFEST.format("ament_lint_common"), **shown, **files}
    )
    result: dict[str, set[str]] = {}
    for item in check(package):
        if item.code in {"E501", "Q000"} and item.location.path in shown:
            result.setdefault(item.location.path, set()).add(item.code)
    return result


BOTH_QUOTED = {"quoted.py": {"Q000"}, "sub/quoted.py": {"Q000"}}
EVERYTHING = {"long.py": {"E501"}, **BOTH_QUOTED}
NO_QUOTES = "[flake8]\nextend-ignore = Q\nmax-line-length = 99\n"


@pytest.mark.parametrize(
    ("argument", "expected"),
    [
        ("argv=[]", EVERYTHING),
        ("argv=['--linelength', '120']", BOTH_QUOTED),
        ("['--linelength', str(120)]", BOTH_QUOTED),
        ("argv=['--config', 'own.cfg']", {"long.py": {"E501"}}),
        ("argv=['--config', os.path.join(HERE, '..', 'own.cfg')]", {"long.py": {"E501"}}),
        ("argv=['--config', str(ROOT / 'own.cfg')]", {"long.py": {"E501"}}),
        ("argv=['--config', str(Path(__file__).parent.parent / 'own.cfg')]", {"long.py": {"E501"}}),
        ("argv=['--config', str(pathlib.Path.cwd() / 'own.cfg')]", {"long.py": {"E501"}}),
        (
            "argv=['--config', os.path.join(os.path.dirname(__file__), os.pardir, 'own.cfg')]",
            {"long.py": {"E501"}},
        ),
        ("argv=['sub', 'test']", {"sub/quoted.py": {"Q000"}}),
        ("argv=['.', '--exclude', 'sub']", {"long.py": {"E501"}, "quoted.py": {"Q000"}}),
        ("argv=['--exclude', './quoted.py', '--', '.']", {**EVERYTHING, "quoted.py": set()}),
        ("argv=['--exclude', 'quoted.py', '--', str(ROOT / 'sub' / '..')]", {"long.py": {"E501"}}),
        ("argv=['--exclude', 'quoted.py', '.']", {}),  # the directory is excluded, too
    ],
)
def test_arguments_of_a_test(
    tmp_path: Path, argument: str, expected: Mapping[str, set[str]]
) -> None:
    files = {"test/test_flake8.py": TEST.format(argument), "own.cfg": NO_QUOTES}
    result = flake8_codes(tmp_path, files)
    assert result == {path: reported for path, reported in expected.items() if reported}


@pytest.mark.parametrize(
    ("commands", "expected"),
    [
        ("ament_flake8()", EVERYTHING),
        ("ament_flake8(MAX_LINE_LENGTH 120)", BOTH_QUOTED),
        ("set(most 120)\nament_flake8(MAX_LINE_LENGTH ${most})", BOTH_QUOTED),
        ("ament_flake8(CONFIG_FILE ${CMAKE_CURRENT_SOURCE_DIR}/../own.cfg)", {"long.py": {"E501"}}),
        ("ament_flake8(TESTNAME x CONFIG_FILE ../own.cfg MAX_LINE_LENGTH 120)", {}),
        ("ament_flake8(sub)", {"sub/quoted.py": {"Q000"}}),
        (
            "ament_flake8(EXCLUDE ${CMAKE_CURRENT_SOURCE_DIR}/quoted.py)",
            {**EVERYTHING, "quoted.py": set()},
        ),
        ("ament_lint_auto_find_test_dependencies()", EVERYTHING),
        (
            (
                "set(ament_cmake_flake8_CONFIG_FILE ../own.cfg)\n"
                "ament_lint_auto_find_test_dependencies()"
            ),
            {"long.py": {"E501"}},
        ),
        (
            (
                "set(AMENT_LINT_AUTO_FILE_EXCLUDE sub/quoted.py long.py)\n"
                "ament_lint_auto_find_test_dependencies()"
            ),
            {"quoted.py": {"Q000"}},
        ),
        (  # what one of two runs reports fails the test
            "ament_flake8(CONFIG_FILE ../own.cfg)\nament_flake8(TESTNAME more sub)",
            {"long.py": {"E501"}, "sub/quoted.py": {"Q000"}},
        ),
        (  # the linter does not run: ament's own configuration
            (
                "set(AMENT_LINT_AUTO_EXCLUDE ament_cmake_flake8)\n"
                "ament_lint_auto_find_test_dependencies()"
            ),
            EVERYTHING,
        ),
        ("ament_flake8(TESTNAME generated ${made_by_the_build})", EVERYTHING),
    ],
)
def test_arguments_in_cmake(
    tmp_path: Path, commands: str, expected: Mapping[str, set[str]]
) -> None:
    result = flake8_codes(
        tmp_path, {"CMakeLists.txt": f"project(a)\n{commands}\n", "../own.cfg": NO_QUOTES}
    )
    assert result == {path: reported for path, reported in expected.items() if reported}


def test_reference_mode_uses_the_configuration_of_ament(tmp_path: Path) -> None:
    cmake = "project(a)\nament_flake8(MAX_LINE_LENGTH 120)\n"
    package = written(tmp_path, {"a.py": LONG, "CMakeLists.txt": cmake})
    assert [d.code for d in check(package)] == []
    assert [d.code for d in check(package, is_reference=True)] == ["E501"]


def test_docstring_codes_ignored_by_flake8(tmp_path: Path) -> None:
    """The package does not run ament_pep257, so its codes are not reported."""
    cfg = "[flake8]\nmax-line-length = 99\nextend-ignore = D1,D400,Q,I\n"
    cmake = "project(a)\nament_flake8(CONFIG_FILE own.cfg)\n"
    text = '"""Do it"""\n'
    package = written(tmp_path, {"a.py": text, "own.cfg": cfg, "CMakeLists.txt": cmake})
    assert [d.code for d in check(package)] == ["D415"]
    assert [d.code for d in check(package, is_reference=True)] == ["D400", "D415"]


def test_own_style_reports_docstring_codes_of_flake8(tmp_path: Path) -> None:
    cmake = "project(a)\nament_flake8(CONFIG_FILE own.cfg)\n"
    files = {"a.py": "x = 1\n", "own.cfg": "[flake8]\n", "CMakeLists.txt": cmake}
    (finding,) = check(written(tmp_path, files))
    assert finding.code == "D100"
    assert runs_linter(Package.at(tmp_path), finding)
    assert not runs_linter(Package.at(tmp_path), finding._replace(code="D415"))


# -- what is not followed


@pytest.mark.parametrize(
    ("configuration", "message"),
    [
        (None, "ament_flake8 stops: its configuration 'own.cfg' cannot be read"),
        ("[flake8]\nignore = E1, # why\n", "in 'own.cfg', 'ignore': '#' is not a code"),
        ("[flake8]\nmax-line-length = 1 # x\n", "in 'own.cfg', 'max-line-length': invalid literal"),
        ("[flake8]\nimport-order-style = mine\n", "'mine' is not one of appnexus,"),
        (
            "[flake8]\nignore = A\nignore = B\n",
            "option 'ignore' in section 'flake8' already exists",
        ),
        ("[flake8]\nper-file-ignores = a.py\n", "'per-file-ignores': codes are missing at the end"),
        ("x\n", "File contains no section headers"),
        ("[flake8]\ndoctests = true\n", "own.cfg: 'doctests': code in docstrings is not checked"),
        ("[flake8:local-plugins]\nextension =\n  X = x:X\n", "names plugins, which are not run"),
    ],
)
def test_unsupported_configuration_is_noted(
    tmp_path: Path, configuration: str | None, message: str
) -> None:
    cmake = "project(a)\nament_flake8(CONFIG_FILE own.cfg)\n"
    files = {"a.py": "x = 1\n", "CMakeLists.txt": cmake}
    files |= {} if configuration is None else {"own.cfg": configuration}
    (note,) = settings_of(written(tmp_path, files)).notes
    assert message in note.message
    diagnostics = [d for d in check(Package.at(tmp_path)) if d.code == "SC006"]
    assert [(d.message, d.location.path, d.location.line) for d in diagnostics] == [
        (note.message, "CMakeLists.txt", 2)
    ]
    if "using ament's" in note.message:
        run = oracles.ament_flake8
        with pytest.raises(AssertionError, match="failed"):
            run(tmp_path, "--config", "own.cfg")


@pytest.mark.parametrize(
    ("argument", "message"),
    [
        ("argv=['--config', given()]", "the configuration of flake8 cannot be determined"),
        ("argv=['--linelength', given()]", "the maximum line length cannot be determined"),
        ("argv=['--exclude', given()]", "the excluded files cannot be determined"),
        ("argv=['--linelength', 'x']", "ament_flake8 stops: argument --linelength: invalid"),
        ("argv=['--length', '3']", "ament_flake8 stops: unrecognized arguments"),
    ],
)
def test_unknown_arguments_are_noted(tmp_path: Path, argument: str, message: str) -> None:
    package = written(tmp_path, {"test/test_flake8.py": TEST.format(argument)})
    notes = [note.message for note in settings_of(package).notes]
    assert len(notes) == 1
    assert message in notes[0]
