"""Checks a package in memory before it is written: rules, and ament's style.

Loading the rules takes as long as drafting a package. `ahead` starts a second process, which loads
them meanwhile and runs them when it receives the package, while the first process checks style.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, BinaryIO, NoReturn

from scaffold import changes, distributions
from scaffold.ament import StyleCheck
from scaffold.distributions import Distribution
from scaffold.files.tree import MemoryTree
from scaffold.generate.repository import inside
from scaffold.model.package import Package
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.check.rules.rule import Rule
    from scaffold.check.session import Session
    from scaffold.diagnostic import Diagnostic
    from scaffold.generate.draft import Draft

    Style = Mapping[str, Sequence[Diagnostic]]
    """Style findings by path."""


WITHOUT_WORKSPACE = ("PX028",)
"""Codes of rules that need the packages around the checked one, which are not loaded here."""


class _Judged(NamedTuple):
    """The part of a draft that is checked, as sent to another process."""

    name: str
    files: Mapping[str, str]
    executable: frozenset[str]
    distributions: Sequence[str]
    """The names of its targets."""

    @property
    def targets(self) -> list[Distribution]:
        """The distributions that the package is for, oldest first."""
        return [distributions.named(name) for name in self.distributions]

    def packages(self) -> list[Package]:
        """Return a package object for each target, since facts are cached per target."""
        return [
            Package(MemoryTree(self.files, self.executable), directory=self.name)
            for _ in self.distributions
        ]


class Check:
    """The check of a draft; the style check starts immediately, in the background.

    Args:
        draft: The draft.
        process: The process that has loaded the rules, if any.
    """

    def __init__(self, draft: Draft, process: RuleProcess | None = None) -> None:
        rendered = draft.rendered
        targets = [target.name for target in draft.targets]
        self._judged = _Judged(draft.name, inside(rendered.files), rendered.executable, targets)
        self._process = process
        if process is not None:
            process.send(self._judged)
        self._packages = self._judged.packages()
        self._checks: list[StyleCheck] = []
        for target, package in zip(draft.targets, self._packages, strict=True):
            with distributions.targeting(target):
                self._checks.append(StyleCheck([package]))

    def end(self) -> list[Diagnostic]:
        """Return the findings of the built-in rules and of style, for each target."""
        styles: list[Style] | None = None
        if self._process is not None:
            styles = self._styles()
            diagnostics = self._process.findings(styles)
            if diagnostics is not None:
                return diagnostics
        session = _session(_built_in())
        return _findings(session, self._judged, self._packages, lambda: styles or self._styles())

    def by(self, rules: Sequence[type[Rule]]) -> list[Diagnostic]:
        """Return the findings of given rules and of style, for each target."""
        return _findings(_session(rules), self._judged, self._packages, self._styles)

    def _styles(self) -> list[Style]:
        result: list[Style] = []
        parts = zip(self._judged.targets, self._packages, self._checks, strict=True)
        for target, package, check in parts:
            with distributions.targeting(target):
                result.append(check.by_file(package))
        return result


def defects(draft: Draft, rules: Sequence[type[Rule]]) -> list[Diagnostic]:
    """Return the findings about a draft: each is a defect of the templates."""
    return Check(draft).by(rules)


def _built_in() -> Sequence[type[Rule]]:
    from scaffold.check.rules import registry
    from scaffold.configuration import content

    return registry.load(content.roots("rules"))


def _session(rules: Sequence[type[Rule]]) -> Session:
    from scaffold.check.selection import Selection
    from scaffold.check.session import Session

    return Session(rules, Selection(ignore=WITHOUT_WORKSPACE), is_remembered=False)


def _findings(
    session: Session,
    judged: _Judged,
    packages: Sequence[Package],
    styles: Callable[[], Sequence[Style]],
) -> list[Diagnostic]:
    """Run the rules, wait for the style findings, and combine both."""
    from scaffold.model.discovery.targets import Target

    ruled = []
    for target, package in zip(judged.targets, packages, strict=True):
        with distributions.targeting(target):
            ruled.append(session.check_rules(package))
    result: list[Diagnostic] = []
    parts = zip(judged.targets, packages, ruled, styles(), strict=True)
    for target, package, diagnostics, style in parts:
        with distributions.targeting(target):
            result += session.result(Target(package), diagnostics, style).diagnostics
    return result


@contextmanager
def ahead() -> Iterator[RuleProcess | None]:
    """Load the rules in a second process, which ends with the block.

    It is ``None`` where that is not possible or does not pay: without ``fork``, with one
    processor, or next to threads, whose locks the process would inherit.
    """
    threading = sys.modules.get("threading")
    is_alone = threading is None or threading.active_count() == 1
    if not (is_alone and hasattr(os, "sched_getaffinity") and len(os.sched_getaffinity(0)) > 1):
        yield None
        return

    process = RuleProcess()
    try:
        yield process
    finally:
        process.close()


class RuleProcess:
    """A process that loads the built-in rules, and runs them on the package it receives."""

    def __init__(self) -> None:
        requests, to = os.pipe()
        answers, back = os.pipe()
        self.number = os.fork()
        """The id of the process."""
        if self.number == 0:
            os.close(to)
            os.close(answers)
            _serve_request(requests, back)
        os.close(requests)
        os.close(back)
        self._to: BinaryIO = os.fdopen(to, "wb")
        self._answers: BinaryIO = os.fdopen(answers, "rb")

    def send(self, message: object) -> None:
        """Send the package, and then its style; `findings` detects a dead process."""
        import pickle

        with suppress(BrokenPipeError):
            pickle.dump(message, self._to)
            self._to.flush()

    def findings(self, styles: Sequence[Style]) -> list[Diagnostic] | None:
        """Return the findings, or ``None`` if the process died."""
        import pickle

        self.send(styles)
        try:
            diagnostics: list[Diagnostic] = pickle.load(self._answers)  # noqa: S301  a process of ours
        except (EOFError, pickle.UnpicklingError):
            return None
        return diagnostics

    def close(self) -> None:
        """Kill the process."""
        import signal

        with suppress(BrokenPipeError):
            self._to.close()
        self._answers.close()
        os.kill(self.number, signal.SIGKILL)
        os.waitpid(self.number, 0)


def _prepare() -> None:
    """Import lazily loaded modules of the rules ahead of time."""
    from importlib import import_module

    for linter in ("cmake_diagnostics", "copyright_diagnostics", "xml.diagnostics"):
        import_module(f"scaffold.ament.{linter}")
    changes.of_kind("name")


def _serve_request(requests: int, back: int) -> NoReturn:
    """Load the rules, check the received package, send the findings, and exit.

    On any error, the first process checks the package itself.
    """
    code = 1
    try:
        import pickle
        import signal

        from scaffold.programs.termination import leave_to_default

        signal.signal(signal.SIGINT, signal.SIG_IGN)  # the first process reports the interruption
        leave_to_default()
        with open(requests, "rb") as source, open(back, "wb") as sink:
            session = _session(_built_in())
            _prepare()
            judged: _Judged = pickle.load(source)  # noqa: S301  a process of ours

            def styles() -> Sequence[Style]:
                sent: Sequence[Style] = pickle.load(source)  # noqa: S301  a process of ours
                return sent

            pickle.dump(_findings(session, judged, judged.packages(), styles), sink)
        code = 0
    finally:
        os._exit(code)
