"""SP050: keywords of setup(), sections of setup.cfg and groups of entry points exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Location, Package, Report, Rule, Severity
from scaffold.api.setup_py import GROUPS

_KNOWN = frozenset(
    """
    author author_email classifiers cmdclass command_options data_files description distclass
    download_url eager_resources entry_points exclude_package_data ext_modules ext_package
    extras_require headers include_dirs include_package_data install_requires keywords license
    license_file license_files long_description long_description_content_type maintainer
    maintainer_email name namespace_packages obsoletes options package_data package_dir packages
    platforms project_urls provides py_modules python_requires requires script_args script_name
    scripts setup_requires test_loader test_suite tests_require url use_2to3 use_scm_version
    version zip_safe
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
_DESCRIBING = frozenset(
    """
    author author_email classifiers description download_url keywords license license_file
    license_files long_description long_description_content_type maintainer maintainer_email
    obsoletes platforms project_urls provides requires url
    """.split()  # noqa: SIM905  as above
)
"""Keywords that describe a package, which ROS takes from package.xml."""
_SECTIONS = frozenset(
    f"options.{name}"
    for name in (
        "packages.find", "package_data", "exclude_package_data", "data_files", "entry_points",
        "extras_require",
    )
)  # fmt: skip
_GROUP = "console_scripts"
_WRONG_GROUPS = frozenset(
    {"console_script", "scripts", "console", "consolescripts", "console-scripts", "executables"}
)
_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    {}={{\n        '{}': ['node = talker.node:main'],\n    }},\n)\n"
)


class KeywordMisspelled(Rule):
    """``setup`` or setup.cfg has an unknown keyword, section or group of entry points.

    **Why.** setuptools only warns ``Unknown distribution option``, or ignores the name silently: no
    executable or file is installed. An unknown section stops the build: ``Unsupported
    distribution option section``.

    **Fix.** Correct the spelling: ``entry_points``, ``data_files``, ``console_scripts``.

    **Source.** setuptools documentation, "Keywords", "Entry points".
    """

    code = "SP050"
    name = "keyword-misspelled"
    other_severities = {Severity.WARNING: "the keyword only describes the package"}
    examples = (
        Example("known", {"setup.py": _SETUP.format("entry_points", _GROUP)}),
        Example(
            "a misspelled keyword",
            {"setup.py": _SETUP.format("entry_point", _GROUP)},
            "6:5: setup() ignores the unknown keyword 'entry_point'; did you mean 'entry_points'?",
        ),
        Example(
            "a misspelled keyword that installs nothing",
            {"setup.py": "from setuptools import setup\n\nsetup(Description='Talks')\n"},
            Report(
                "3:7",
                "setup() ignores the unknown keyword 'Description'; did you mean 'description'?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a misspelled group",
            {"setup.py": _SETUP.format("entry_points", "console_script")},
            "7:9: setuptools ignores the unknown group 'console_script'; did you mean "
            "'console_scripts'?",
        ),
        Example(
            "a misspelled group in setup.cfg",
            {"setup.cfg": "[options.entry_points]\nconsole_script =\n  node = talker.node:main\n"},
            "2:1: setuptools ignores the unknown group 'console_script'; did you mean "
            "'console_scripts'?",
        ),
        Example(
            "sections and options of setup.cfg",
            {"setup.cfg": "[options]\npackages = find:\n[options.packages.find]\nexclude = test\n"},
        ),
        Example(
            "a misspelled section and option of setup.cfg",
            {"setup.cfg": "[options]\npackage = find:\n[options.data-files]\nshare/a = a.yaml\n"},
            "setup.cfg:2:1: setuptools ignores the unknown option 'package'; did you mean "
            "'packages'?",
            "setup.cfg:3:2: setuptools rejects the unknown section [options.data-files]: the "
            "build stops; did you mean [options.data_files]?",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_configured(package)
        yield from self._check_setup(package)

    def _check_configured(self, package: Package) -> Iterator[Diagnostic]:
        cfg = package.setup_cfg if package.has("setup.cfg") else None
        for name, section in cfg.sections.items() if cfg else ():
            if name.startswith("options.") and name not in _SECTIONS:
                closest = get_close_matches(name, _SECTIONS, 1, 0.8)
                hint = f"; did you mean [{closest[0]}]?" if closest else ""
                message = f"setuptools rejects the unknown section [{name}]: the build stops{hint}"
                yield self.report(section.name_location, message)
            for key, option in section.options.items():
                if name == GROUPS and key in _WRONG_GROUPS:
                    yield self._report_group(option.key_location, key)
                elif name == "options" and key.replace("-", "_") not in _KNOWN:
                    closest = get_close_matches(key, _KNOWN, 1, 0.8)
                    message = f"setuptools ignores the unknown option {key!r}; did you mean"
                    if closest:
                        yield self.report(option.key_location, f"{message} {closest[0]!r}?")

    def _check_setup(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        for word in setup.call.keywords if setup.call else ():
            if word.arg is None or word.arg in _KNOWN:
                continue
            closest = get_close_matches(word.arg, _KNOWN, 1, 0.8)
            if closest:
                message = (
                    f"setup() ignores the unknown keyword {word.arg!r}; did you mean "
                    f"{closest[0]!r}?"
                )
                severity = Severity.WARNING if closest[0] in _DESCRIBING else None
                yield self.report(setup.module.location(word), message, severity=severity)
        keyword = setup.keyword("entry_points")
        node = keyword.node if keyword else None
        if isinstance(node, ast.Dict):
            for key in node.keys:
                if isinstance(key, ast.Constant) and key.value in _WRONG_GROUPS:
                    yield self._report_group(setup.module.location(key), str(key.value))

    def _report_group(self, place: Location, name: str) -> Diagnostic:
        message = f"setuptools ignores the unknown group {name!r}; did you mean {_GROUP!r}?"
        return self.report(place, message)
