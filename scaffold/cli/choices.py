"""The selection of rules and their settings, from the configuration and the flags."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.check.adjustments import Adjustments
    from scaffold.check.rules.rule import Rule
    from scaffold.check.selection import Selection
    from scaffold.configuration.config import Config
    from scaffold.model.workspace.policy import Policy


class Choices:
    """Resolves codes and names in the configuration and the flags to rules.

    Args:
        settings: The configuration.
        rules: The rules of content directories.
    """

    def __init__(self, settings: Config, rules: Sequence[type[Rule]]) -> None:
        self._settings = settings
        self.rules = rules
        self._names: dict[str, str] = {}
        self._areas: dict[str, str] = {}

    def selection(
        self, select: Sequence[str] | None = None, ignore: Sequence[str] | None = None
    ) -> Selection:
        """Return the selected codes.

        Args:
            select: The values of the flag, which override the configuration.
            ignore: Likewise.

        Raises:
            ConfigError: a word matches no rule.
        """
        from scaffold.check.selection import Selection, split

        chosen: dict[str, tuple[str, ...]] = {}
        for name, flag in (("select", select), ("ignore", ignore)):
            words, origin = split(flag), f"--{name}"
            key = f"check.{name}"
            if not words and key in self._settings.values:
                words, origin = split(self._settings.strings(key)), self._origin_of(key)
            chosen[name] = self._prefixes(words, origin)
        key = "check.per-path-ignores"
        per_path = {
            pattern: self._prefixes(words, f"{self._origin_of(key)}: {pattern!r}")
            for pattern, words in self._settings.value(key).items()
        }
        origin = self._settings.origin(key) if per_path else ""
        return Selection(chosen["select"], chosen["ignore"], per_path, origin)

    def adjustments(self, *, is_release: bool = False, include_all: bool = False) -> Adjustments:
        """Return the other adjustments of findings by the configuration.

        Args:
            is_release: Whether findings that block a release are errors, unless the configuration
                says otherwise.
            include_all: Whether foreign files are checked as well.

        Raises:
            ConfigError: a word matches no rule.
        """
        from scaffold.check.adjustments import Adjustments
        from scaffold.configuration.exclusion import Exclusion
        from scaffold.diagnostic import Severity
        from scaffold.model.discovery.foreign import Foreign

        key = "check.severity"
        severities = {
            prefix: Severity(severity)
            for word, severity in self._settings.value(key).items()
            for prefix in self._prefixes([word], self._origin_of(key))
        }
        key = "check.exclude"
        patterns = self._settings.strings(key)
        exclusion = Exclusion(patterns, self._settings.origin(key)) if patterns else Exclusion()
        is_own = self._settings.value("check.style") == "own"
        refused = self._refused_at_release() if is_release else frozenset()
        kinds = () if include_all else self._settings.strings("check.default-excludes")
        return Adjustments(severities, is_own, exclusion, refused, Foreign(kinds))

    @property
    def line_length(self) -> int | None:
        """The line length for packages that do not run flake8 themselves."""
        value: int = self._settings.value("check.line-length")
        return value if "check.line-length" in self._settings.values else None

    def policy(self) -> Policy:
        """Return the configuration of rules."""
        from scaffold.model.workspace.policy import Policy

        implicit = self._settings.strings("check.implicit-dependencies")
        return Policy(self._settings.strings("check.licenses"), implicit)

    def _refused_at_release(self) -> frozenset[str]:
        from scaffold.check.session import all_rules

        return frozenset(rule.code for rule in all_rules(self.rules) if rule.release_refused)

    def _origin_of(self, key: str) -> str:
        return f"{self._settings.origin(key)}: {key}"

    def _prefixes(self, words: Sequence[str], origin: str) -> tuple[str, ...]:
        from scaffold.check import selection

        if words and not self._names:
            self._names, self._areas = _names(self.rules), selection.area_prefixes(self.rules)
        return selection.resolve(words, self._names, self._areas, origin)


def _names(rules: Sequence[type[Rule]]) -> dict[str, str]:
    """Return the names of all codes that can be reported."""
    from scaffold.ament.codes import CODES
    from scaffold.check.session import all_rules

    return {
        **{code: style.name for code, style in CODES.items()},
        **{rule.code: rule.name for rule in all_rules(rules)},
    }
