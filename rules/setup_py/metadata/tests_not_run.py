"""SP012: ``colcon test`` runs the tests with pytest."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
)
from scaffold.api.distributions import target
from scaffold.api.setup_py import (
    EXTRAS,
    SECTION,
    IniFile,
    IniOption,
    SetupPy,
    has_extra,
    lacks_pytest,
    setup_cfg,
    setup_edit,
)

_IGNORING = 72
"""The first setuptools that ignores tests_require."""
_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n{})\n"
_NEW = "extras_require={'test': ['pytest']}"
_EXTRA = f"    {_NEW},\n"
_CFG = "[options]\nzip_safe = true\n{}"
_OLD_CFG = _CFG.format(
    "tests_require =\n    pytest\n    numpy\n[develop]\nscript_dir=$base/lib/a\n"
)
_NEW_CFG = _CFG.format(
    "[develop]\nscript_dir=$base/lib/a\n\n[options.extras_require]\ntest =\n    pytest\n    numpy\n"
)
_TEST = "def test_talk():\n    pass\n"


class TestsNotRun(Rule):
    """setup.py does not declare pytest for the tests, or does so with ``tests_require``.

    setup.cfg may declare it instead.

    **Why.** ``colcon test`` falls back to unittest, which finds no tests in pytest files: ``Ran 0
    tests ... OK``. setuptools 72 removed ``tests_require``; the version in Ubuntu 24.04 still
    supports it.

    **Fix.** Write ``extras_require={'test': ['pytest']}``, or ``test = pytest`` under
    ``[options.extras_require]`` in setup.cfg.

    **Source.** ``colcon_core/task/python/test``; colcon-core issue 678;
    ros2_documentation issue 4727.
    """

    code = "SP012"
    name = "tests-not-run"
    effect = Effect.DECLARED_WRONG
    is_fixed_for_all = True
    is_deprecation = True
    other_severities = {
        Severity.INFO: "it is declared with ``tests_require``, which Ubuntu 24.04 still supports",
        Severity.WARNING: "the tests only run linters of ament",
    }
    examples = (
        Example(
            "pytest declared", {"setup.py": _SETUP.format(_EXTRA), "test/test_talker.py": _TEST}
        ),
        Example("no tests", {"setup.py": _SETUP.format("")}),
        Example(
            "unittest tests, which colcon runs without pytest",
            {
                "setup.py": _SETUP.format(""),
                "test/__init__.py": "",
                "test/test_talker.py": "import unittest\n\n\n"
                "class TestTalker(unittest.TestCase):\n\n"
                "    def test_talk(self):\n        self.assertTrue('talk')\n",
            },
        ),
        Example(
            "pytest not declared; the only test comes from ``ros2 pkg create``",
            {
                "setup.py": _SETUP.format(""),
                "test/test_flake8.py": "from ament_flake8.main import main_with_errors\n"
                "import pytest\n\n\n@pytest.mark.flake8\ndef test_flake8():\n"
                "    assert main_with_errors(argv=[])[0] == 0\n",
            },
            Report(
                "setup.py:3:1",
                "pytest is not declared for test/: colcon runs 0 tests; add "
                "extras_require={'test': ['pytest']}",
                fix="Add extras_require={'test': ['pytest']}",
                severity=Severity.WARNING,
            ),
            fixed={"setup.py": _SETUP.format(_EXTRA)},
        ),
        Example(
            "pytest not declared",
            {"setup.py": _SETUP.format(""), "test/test_talker.py": _TEST},
            Report(
                "setup.py:3:1",
                "pytest is not declared for test/: colcon runs 0 tests; add "
                "extras_require={'test': ['pytest']}",
                fix="Add extras_require={'test': ['pytest']}",
            ),
            fixed={"setup.py": _SETUP.format(_EXTRA)},
        ),
        Example(
            "tests_require",
            {"setup.py": _SETUP.format("    tests_require=['pytest'],\n")},
            Report(
                "5:19",
                "setuptools 72 and later, which Jazzy does not have, ignore "
                "tests_require: colcon will run 0 tests; write extras_require={'test': "
                "['pytest']}",
                fix="Replace with extras_require={'test': ['pytest']}",
                severity=Severity.INFO,
            ),
            fixed={"setup.py": _SETUP.format(_EXTRA)},
        ),
        Example(
            "tests_require, with a setuptools that ignores it",
            {"setup.py": _SETUP.format("    tests_require=['pytest'],\n")},
            Report(
                "5:19",
                "setuptools of Lyrical ignores tests_require: colcon runs 0 tests; "
                "write extras_require={'test': ['pytest']}",
                fix="Replace with extras_require={'test': ['pytest']}",
            ),
            fixed={"setup.py": _SETUP.format(_EXTRA)},
            distro="lyrical",
        ),
        Example(
            "tests_require with several packages",
            {"setup.py": _SETUP.format("    tests_require=['pytest', 'numpy>=1.2'],\n")},
            Report(
                "5:19",
                "setuptools of Lyrical ignores tests_require: colcon runs 0 tests; "
                "write extras_require={'test': ['pytest', 'numpy>=1.2']}",
                fix="Replace with extras_require={'test': ['pytest', 'numpy>=1.2']}",
            ),
            fixed={
                "setup.py": _SETUP.format(
                    "    extras_require={'test': ['pytest', 'numpy>=1.2']},\n"
                )
            },
            distro="lyrical",
        ),
        Example(
            "tests_require with the other quotes",
            {"setup.py": _SETUP.format('    tests_require=["pytest"],\n')},
            Report(
                "5:19",
                "setuptools of Lyrical ignores tests_require: colcon runs 0 tests; "
                'write extras_require={"test": ["pytest"]}',
                fix='Replace with extras_require={"test": ["pytest"]}',
            ),
            fixed={"setup.py": _SETUP.format('    extras_require={"test": ["pytest"]},\n')},
            distro="lyrical",
        ),
        Example(
            "tests_require next to other extras",
            {
                "setup.py": _SETUP.format(
                    "    tests_require='pytest',\n    extras_require={'dev': ['black']},\n"
                )
            },
            "5:19: setuptools of Lyrical ignores tests_require: colcon runs 0 tests; add 'test': "
            "['pytest'] to extras_require",
            distro="lyrical",
        ),
        Example(
            "tests_require in setup.cfg",
            {"setup.py": "from setuptools import setup\n\nsetup()\n", "setup.cfg": _OLD_CFG},
            Report(
                "setup.cfg:3:1",
                "setuptools of Lyrical ignores tests_require: colcon runs 0 tests; add "
                "`test` to [options.extras_require]",
                fix="Move the option to [options.extras_require]",
            ),
            fixed={"setup.cfg": _NEW_CFG},
            distro="lyrical",
        ),
        Example(
            "tests_require in setup.cfg, as the last line",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": _CFG.format("tests_require = pytest\n"),
            },
            Report(
                "setup.cfg:3:1",
                "setuptools of Lyrical ignores tests_require: colcon runs 0 tests; add "
                "`test` to [options.extras_require]",
                fix="Move the option to [options.extras_require]",
            ),
            fixed={"setup.cfg": _CFG.format("[options.extras_require]\ntest = pytest\n")},
            distro="lyrical",
        ),
        Example(
            "extras in setup.cfg",
            {
                "setup.py": _SETUP.format(""),
                "setup.cfg": _NEW_CFG,
                "test/test_talker.py": _TEST,
            },
            distro="lyrical",
        ),
        Example(
            "tests_require in setup.cfg, which is supported",
            {
                "setup.py": _SETUP.format(""),
                "setup.cfg": _CFG.format("tests_require = pytest\n"),
                "test/test_talker.py": _TEST,
            },
            Report(
                "setup.cfg:3:1",
                "setuptools 72 and later, which Jazzy does not have, ignore "
                "tests_require: colcon will run 0 tests; add `test` to "
                "[options.extras_require]",
                fix="Move the option to [options.extras_require]",
                severity=Severity.INFO,
            ),
            fixed={"setup.cfg": _CFG.format("[options.extras_require]\ntest = pytest\n")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if setup.keyword("tests_require") is not None:
            yield from self._check_tests_require(package, setup)
            return
        cfg = setup_cfg(package)
        option = cfg.option("options", "tests_require", "tests-require") if cfg else None
        if cfg is not None and option is not None:
            yield from self._check_option(package, cfg, option)
            return
        if not lacks_pytest(package):
            return
        tests = [*package.glob("test/test_*.py"), *package.glob("tests/test_*.py")]
        tests = [path for path in tests if _needs_pytest(package, path)]
        if not tests:
            return
        edit = setup_edit.insert(setup, _NEW)
        can_fix = edit is not None and setup.keyword("extras_require") is None
        directory = tests[0].partition("/")[0]
        message = f"pytest is not declared for {directory}/: colcon runs 0 tests; add {_NEW}"
        fix = Fix(f"Add {_NEW}", (edit,)) if edit and can_fix else None
        is_generated = all(_is_of_linter(package, path) for path in tests)
        yield self.report(setup, message, fix, severity=Severity.WARNING if is_generated else None)

    def _check_tests_require(self, package: Package, setup: SetupPy) -> Iterator[Diagnostic]:
        old = setup.keyword("tests_require")
        if old is None or has_extra(package):
            return
        requirements = setup.module.text(old.node)
        if isinstance(old.value, str):
            requirements = f"[{requirements}]"
        quote = '"' if '"' in requirements and "'" not in requirements else "'"
        extra = f"{quote}test{quote}: {requirements}"
        written = f"extras_require={{{extra}}}"
        shown = " ".join(written.split())
        span = setup_edit.span(setup, "tests_require")
        fix, advice = None, f"write {shown}"
        if setup.keyword("extras_require") is not None:
            advice = f"add {' '.join(extra.split())} to extras_require"
        elif span is not None:
            fix = Fix(f"Replace with {shown}", (Edit("setup.py", *span, written),))
        yield self.report(old, f"{_ignored()}; {advice}", fix, severity=_severity())

    def _check_option(
        self, package: Package, cfg: IniFile, option: IniOption
    ) -> Iterator[Diagnostic]:
        """Check setup.cfg, where the option moves to another section."""
        if has_extra(package):
            return
        fix, advice = None, f"add `test` to [{SECTION}]"
        extras = cfg.sections.get(SECTION)
        if extras is None or not set(EXTRAS) & {*extras.options}:
            fix = Fix(f"Move the option to [{SECTION}]", (*_moved(cfg, option),))
        yield self.report(option.key_location, f"{_ignored()}; {advice}", fix, severity=_severity())


def _needs_pytest(package: Package, path: str) -> bool:
    """Return whether unittest skips a test file or parts of it."""
    if not package.has(f"{path.rpartition('/')[0]}/__init__.py"):
        return True
    try:
        module = package.module(path)
    except ViewError:
        return True
    bases = [module.text(base) for item in module.classes.values() for base in item.node.bases]
    is_written_for_it = any(base.endswith("TestCase") for base in bases)
    return not is_written_for_it or any(name.startswith("test") for name in module.functions)


def _is_of_linter(package: Package, path: str) -> bool:
    """Return whether a test only runs a linter of ament, as those of ``ros2 pkg create`` do."""
    roots = package.imports(path) - {"pytest"}
    return bool(roots) and all(
        root.startswith("ament_") and root != "ament_index_python" for root in roots
    )


def _has_new_setuptools() -> bool:
    return int(target().fact("setuptools").partition(".")[0]) >= _IGNORING


def _severity() -> Severity | None:
    return None if _has_new_setuptools() else Severity.INFO


def _ignored() -> str:
    if _has_new_setuptools():
        return f"setuptools of {target().title} ignores tests_require: colcon runs 0 tests"
    return (
        f"setuptools {_IGNORING} and later, which {target().title} does not have, ignore "
        "tests_require: colcon will run 0 tests"
    )


def _moved(cfg: IniFile, option: IniOption) -> Iterator[Edit]:
    """Yield the edits that move the requirements of tests to the section of extras."""
    newline = cfg.source.newline
    lines = [line.text for line in option.lines]
    separator = f"{newline}    "
    value = f" {lines[0]}" if len(lines) == 1 else separator + separator.join(lines)
    added = cfg.set(SECTION, "test ", value)
    end = option.end + len(newline)
    if option.start <= added.start <= end:
        # The section replaces the option.
        yield Edit(added.path, option.start, option.end, added.text.lstrip())
        return
    gap = newline if SECTION not in cfg.sections else ""
    yield Edit(added.path, option.start, end, "")
    yield Edit(added.path, added.start, added.end, f"{gap}{added.text}")
