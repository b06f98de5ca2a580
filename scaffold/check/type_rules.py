"""Base class of rules that turn reports of the type checker into findings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, ClassVar

from scaffold.check.file_rules import FileRule
from scaffold.diagnostic import Diagnostic
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.types.finding import TypeFinding
    from scaffold.types.ty import TyDiagnostic

    Reported = Mapping[str, Sequence[TyDiagnostic]]

_KEY = "reported by the type checker"


class TypeRule(FileRule):
    """A rule about reports of the type checker; a subclass has ``judge``."""

    kinds: ClassVar[frozenset[str]]
    """The rules of the type checker that it is made of."""

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that something is reported about."""
        return [*_reported(package)]

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file; nothing in one for ROS 1, whose messages are others."""
        roots = package.imports(path)
        if "rospy" in roots and "rclpy" not in roots:
            return
        for item in _reported(package).get(path, ()):
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
        """Return what is wrong, ``None`` where that is not certain; may raise ViewError."""
        raise NotImplementedError


def _reported(package: Package) -> Reported:
    def run() -> Reported:
        from scaffold.types.check import TypeCheck

        return TypeCheck([package]).by_file(package)

    return package.remember(_KEY, run)


def give(package: Package, reported: Reported) -> None:
    """Hand the rules what was reported in a package, until its views are dropped."""
    package.remember(_KEY, lambda: reported)
