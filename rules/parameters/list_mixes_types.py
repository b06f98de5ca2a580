"""PF005: all items of a list have the same type."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.formats import Scalar, Sequence
from scaffold.api.parameters import mixed, parameter_file, parameter_paths, scalar_type

_FILE = "talker:\n  ros__parameters:\n    gains: {}\n"


class ListMixesTypes(Rule):
    """A list in a parameter file has items of different types.

    **Why.** The node does not start: ``RCLError: failed to initialize rcl: Couldn't parse params
    file ... Sequence should be of same type``.

    **Fix.** Write ``1.0`` among doubles, and quote words that YAML reads as another type.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``.
    """

    code = "PF005"
    name = "list-mixes-types"
    examples = (
        Example("the same type", {"config/a.yaml": _FILE.format("[1.0, 2.5]")}),
        Example(
            "integers among doubles",
            {"config/a.yaml": _FILE.format("[1, 2.5, -3]")},
            Report(
                "3:16",
                "list 'gains' mixes integer (1) and double (2.5): rcl rejects the file",
                fix="write all as doubles",
            ),
            fixed={"config/a.yaml": _FILE.format("[1.0, 2.5, -3.0]")},
        ),
        Example(
            "a word that YAML reads as a boolean",
            {"config/a.yaml": _FILE.format("[left, right, off]")},
            Report("3:26", "list 'gains' mixes string (left) and bool (off): rcl rejects the file"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            file = parameter_file(package, path)
            for section in file.sections if file else ():
                for entry in section.entries:
                    mixture = mixed(entry.value)
                    if mixture is None or not isinstance(entry.value, Sequence):
                        continue
                    first, kind, other, other_kind = mixture
                    message = (
                        f"list {entry.name!r} mixes {kind} ({first.text}) and {other_kind} "
                        f"({other.text}): rcl rejects the file"
                    )
                    yield self.report(other, message, self._fix(path, entry.value))

    def _fix(self, path: str, value: Sequence) -> Fix | None:
        scalars = [item for item in value.items if isinstance(item, Scalar)]
        kinds = [scalar_type(item) for item in scalars]
        if set(kinds) != {"integer", "double"}:
            return None
        whole = [item for item, kind in zip(scalars, kinds, strict=True) if kind == "integer"]
        if not all(item.text.lstrip("+-").isdecimal() for item in whole):
            return None
        edits = tuple(Edit(path, item.end, item.end, ".0") for item in whole)
        return Fix("write all as doubles", edits)
