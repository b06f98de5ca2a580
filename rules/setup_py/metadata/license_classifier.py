"""SP058: the license is not declared with a classifier."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.distributions import target
from scaffold.api.setup_py import SetupPy

_WARNING = 77
"""The first setuptools that warns about them."""
_BEGINNING = "License :: "
_APACHE = "License :: OSI Approved :: Apache Software License"
_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n{}    classifiers=[\n"
    "        'Programming Language :: Python',\n{}    ],\n)\n"
)
_LICENSE = "    license='Apache-2.0',\n"


class LicenseClassifier(Rule):
    """A classifier in setup.py declares the license, which setuptools has deprecated.

    **Why.** setuptools 77 and later, as on Lyrical, warns in each build: ``License classifiers are
    deprecated``. With a license expression in pyproject.toml, it stops.

    **Fix.** Remove the classifier, and set ``license`` in setup.py. The automatic fix removes it if
    ``license`` is set.

    **Source.** ``setuptools/dist.py``, since 77.0; PEP 639; rqt_reconfigure pull request 153.
    """

    code = "SP058"
    name = "license-classifier"
    severity = Severity.INFO
    effect = Effect.DECLARED_WRONG
    is_deprecation = True
    is_fixed_for_all = True
    examples = (
        Example(
            "an older setuptools, which does not warn",
            {"setup.py": _SETUP.format(_LICENSE, f"        '{_APACHE}',\n")},
        ),
        Example("other classifiers", {"setup.py": _SETUP.format(_LICENSE, "")}, distro="lyrical"),
        Example(
            "a classifier",
            {"setup.py": _SETUP.format(_LICENSE, f"        '{_APACHE}',\n")},
            Report(
                "8:9",
                "license classifiers are deprecated in setuptools 78.1.1 of Lyrical; remove it",
                fix="Remove the classifier",
            ),
            fixed={"setup.py": _SETUP.format(_LICENSE, "")},
            distro="lyrical",
        ),
        Example(
            "no license argument",
            {"setup.py": _SETUP.format("", f"        '{_APACHE}',\n")},
            "7:9: license classifiers are deprecated in setuptools 78.1.1 of Lyrical; write "
            "license='...' instead",
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setuptools = target().fact("setuptools")
        if int(setuptools.partition(".")[0]) < _WARNING or not package.has("setup.py"):
            return
        setup = package.setup_py
        classifiers = setup.keyword("classifiers")
        if classifiers is None or not isinstance(classifiers.node, ast.List):
            return
        named = [item for item in classifiers.node.elts if _is_license(item)]
        has_license = setup.keyword("license") is not None
        advice = "remove it" if has_license else "write license='...' instead"
        for item in named:
            is_last = len(named) == len(classifiers.node.elts)
            edit = _removal(setup, item) if has_license and not is_last else None
            message = (
                f"license classifiers are deprecated in setuptools {setuptools} of {target().title}"
            )
            fix = Fix("Remove the classifier", (edit,)) if edit else None
            yield self.report(setup.module.location(item), f"{message}; {advice}", fix)


def _is_license(item: ast.expr) -> bool:
    is_text = isinstance(item, ast.Constant) and isinstance(item.value, str)
    return is_text and str(ast.literal_eval(item)).startswith(_BEGINNING)


def _removal(setup: SetupPy, item: ast.expr) -> Edit | None:
    """Return the edit that removes the lines of an item, if they contain nothing else."""
    start, end = setup.module.span(item)
    text = setup.module.source.text
    first = text.rfind("\n", 0, start) + 1
    after = text.find("\n", end) + 1
    if not after or text[first:start].strip() or text[end:after].strip() not in {",", ""}:
        return None
    return Edit(setup.module.path, first, after, "")
