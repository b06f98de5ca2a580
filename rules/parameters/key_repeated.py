"""PF030: parameter files set each parameter once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, ParseError, Rule, Severity
from scaffold.api.formats import Mapping, Scalar, yaml_tree
from scaffold.api.parameters import parameter_paths

_FILE = "talker:\n  ros__parameters:\n    rate: 2.0\n    {}: 3.0\n"


class KeyRepeated(Rule):
    """A parameter file sets a parameter twice in one section.

    **Why.** The later value silently overrides the first. (Repeated sections are merged.)

    **Fix.** Remove one of them.

    **Source.** YAML 1.2, section 3.2.1.1: keys are unique.
    """

    code = "PF030"
    name = "key-repeated"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("once", {"a.yaml": _FILE.format("speed")}),
        Example(
            "twice",
            {"a.yaml": _FILE.format("rate")},
            "4:5: 'rate' is already set in line 3: the first value is ignored; remove one of them",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            try:
                roots = yaml_tree.parse(package.source(path))
            except ParseError:
                continue
            for _, mapping in yaml_tree.mappings(roots):
                for key, first in _repeated(mapping):
                    message = f"{key.text!r} is already set in line {first.location.line}: "
                    message += "the first value is ignored; remove one of them"
                    yield self.report(key, message)


def _repeated(mapping: Mapping) -> Iterator[tuple[Scalar, Scalar]]:
    """Yield repeated keys, each with its first occurrence."""
    seen: dict[str, Scalar] = {}
    for key, value in mapping.pairs:
        if isinstance(value, Mapping):
            continue
        first = seen.setdefault(key.text, key)
        if first is not key:
            yield key, first
