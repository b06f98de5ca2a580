"""Base class of rules that turn reports of the type checker into findings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, ClassVar

from scaffold import time_limit
from scaffold.check.rules.file_rules import FileRule
from scaffold.diagnostic import Diagnostic
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.types.finding import TypeFinding
    from scaffold.types.ty import TyDiagnostic

    Reported = Mapping[str, Sequence[TyDiagnostic]]

_KEY = "reported by the type checker"


class TypeRule(FileRule):
    """A rule about reports of the type checker; a subclass defines ``judge``."""

    kinds: ClassVar[frozenset[str]]
    """The rules of the type checker that it uses."""

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files with reports."""
        return [*_reported(package)]

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        yield from self.judge_all(package, path, _reported(package).get(path, ()))

    def judge_all(
        self, package: Package, path: str, reported: Sequence[TyDiagnostic]
    ) -> Iterator[Diagnostic]:
        """Yield the findings in a file; none in one for ROS 1, which has other messages."""
        roots = package.imports(path)
        if "rospy" in roots and "rclpy" not in roots:
            return
        for item in reported:
            if item.kind in self.kinds:
                with suppress(ViewError):
                    yield from self._judged(package, path, item)

    def _judged(self, package: Package, path: str, item: TyDiagnostic) -> Iterator[Diagnostic]:
        from scaffold.types.finding import TypeFinding

        finding = TypeFinding(package, path, item)
        result = self.judge(finding)
        if result is not None and finding.is_certain():
            passed = finding.passed_in()
            comes = f" ({passed[0]!r} comes from {passed[1]})" if passed else ""
            yield result._replace(message=f"{result.message}{comes}")

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        """Return the problem, ``None`` if uncertain; may raise ViewError."""
        raise NotImplementedError


def is_any_wrong(
    rules: Sequence[TypeRule], package: Package, path: str, reported: Sequence[TyDiagnostic]
) -> bool:
    """Return whether any of some reports about a file leads to a finding, as far as known."""
    try:
        with time_limit.limited():
            return any(any(rule.judge_all(package, path, reported)) for rule in rules)
    except ViewError:
        return False
    except Exception:  # noqa: BLE001  the rule fails again when it is run, and that is reported
        return True


def _reported(package: Package) -> Reported:
    def run() -> Reported:
        from scaffold.types.check import TypeCheck

        return TypeCheck([package]).by_file(package)

    return package.remember(_KEY, run)


def give(package: Package, reported: Reported) -> None:
    """Give the rules the reports about a package, until its views are dropped."""
    package.remember(_KEY, lambda: reported)
