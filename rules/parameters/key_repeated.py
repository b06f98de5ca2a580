"""PF030: parameter files set each parameter once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, ParseError, Rule, Severity
from scaffold.api.formats import Mapping, Scalar, YamlNode, yaml_tree
from scaffold.api.parameters import parameter_paths

_FILE = "talker:\n  ros__parameters:\n    rate: 2.0\n    {}: 3.0\n"


class KeyRepeated(Rule):
    """A parameter file sets a parameter of a node twice.

    **Why.** The later value silently overrides the first. Repeated sections are merged.

    **Fix.** Remove one of them.

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
            "4:5: 'rate' is already set in line 3: the first value is ignored; remove one of them",
        ),
        Example(
            "in two sections of one node; in two nodes",
            {
                "a.yaml": _FILE.format("speed") + "listener:\n  ros__parameters:\n    speed: 1.0\n"
                "talker:\n  ros__parameters:\n    rate: 4.0\n"
            },
            "10:5: 'rate' is already set in line 3: the first value is ignored; remove one of them",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            try:
                roots = yaml_tree.parse(package.source(path))
            except ParseError:
                continue
            seen: dict[tuple[str, ...], Scalar] = {}
            for root in roots:
                for names, key in _values(root, ()):
                    first = seen.setdefault(names, key)
                    if first is not key:
                        message = f"{key.text!r} is already set in line {first.location.line}: "
                        message += "the first value is ignored; remove one of them"
                        yield self.report(key, message)


def _values(node: YamlNode, above: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Scalar]]:
    """Yield the keys of all values, each with its own name and the names above it."""
    for key, value in node.pairs if isinstance(node, Mapping) else ():
        names = (*above, key.text)
        if isinstance(value, Mapping):
            yield from _values(value, names)
        else:
            yield names, key
