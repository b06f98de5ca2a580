"""PF030: parameter files name everything once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, ParseError, Report, Rule, Severity
from scaffold.api.formats import Mapping, Scalar, Sequence, YamlNode, yaml_tree
from scaffold.api.parameters import parameter_paths

_FILE = "talker:\n  ros__parameters:\n    rate: 2.0\n    {}: 3.0\n"


class KeyRepeated(Rule):
    """A parameter file sets a parameter twice in one place.

    **Why.** The later one wins, without a word: what stands above is not what the node gets.
    (Sections that are repeated are merged.)

    **Fix.** Keep one.

    **Source.** YAML 1.2, section 3.2.1.1: keys are unique.
    """

    code = "PF030"
    name = "key-repeated"
    severity = Severity.WARNING
    examples = (
        Example("once", {"a.yaml": _FILE.format("speed")}),
        Example(
            "twice",
            {"a.yaml": _FILE.format("rate")},
            reports=(
                Report("a.yaml:4:5", "'rate' stands in line 3 already: only this one counts"),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            try:
                pending: list[YamlNode] = list(yaml_tree.parse(package.source(path)))
            except ParseError:
                continue
            for node in pending:  # grows on the way
                if isinstance(node, Sequence):
                    pending += node.items
                elif isinstance(node, Mapping):
                    pending += [value for _, value in node.pairs]
                    for key, first in _repeated(node):
                        line = first.location.line
                        message = (
                            f"{key.text!r} stands in line {line} already: only this one counts"
                        )
                        yield self.report(key, message)


def _repeated(mapping: Mapping) -> Iterator[tuple[Scalar, Scalar]]:
    """Yield the keys that are there already, with the first of each."""
    seen: dict[str, Scalar] = {}
    for key, value in mapping.pairs:
        if isinstance(value, Mapping):
            continue
        first = seen.setdefault(key.text, key)
        if first is not key:
            yield key, first
