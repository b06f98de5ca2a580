"""The Python files as the type checker reads them, rewritten once for each content."""

from __future__ import annotations

from collections.abc import Callable

from scaffold.record import NamedTuple
from scaffold.types.findings_cache import ReportCache
from scaffold.types.rewriting import parameter_values
from scaffold.types.rewriting.added_lines import Extended
from scaffold.types.rewriting.arguments import with_arguments
from scaffold.types.rewriting.mixins import with_nodes_as_self
from scaffold.types.rewriting.passed import Passed, other_roots
from scaffold.types.rewriting.unannotated import without_annotations
from scaffold.types.sources import Source


class Rewritten(NamedTuple):
    """A file for the type checker."""

    text: bytes
    """The file without the lines that are added."""
    written: Extended

    @classmethod
    def of(cls, source: Source, *, is_annotated: bool) -> Rewritten:
        """Rewrite a file of a package, with or without its annotations."""
        text = source.with_callback_types
        if not is_annotated:
            text = without_annotations(text) or b""  # if it does not parse
        text = parameter_values.with_types(text)
        others = other_roots(source.package, source.data)
        return cls(text, with_nodes_as_self(with_arguments(text, source.dotted, (), others)))


Rewrite = Callable[[Source], Rewritten]
"""Rewrites a file."""


def rewriting(cache: ReportCache, *, is_annotated: bool) -> Rewrite:
    """Return a function that rewrites files; stubs are unchanged.

    Args:
        cache: What it stores the results in.
        is_annotated: Whether the user's annotations remain.
    """

    def rewrite(source: Source) -> Rewritten:
        if not source.path:
            return Rewritten(source.data, Extended(source.data, ()))
        about = "annotated" if is_annotated else "unannotated"
        others = " ".join(sorted(other_roots(source.package, source.data)))
        key = cache.key(source, {source.place: source}, f"{about} {others}")
        stored = cache.get_value(key)
        if stored is not None:
            text, data, added, passed = stored
            return Rewritten(text, Extended(data, added, [Passed(*call) for call in passed]))
        result = Rewritten.of(source, is_annotated=is_annotated)
        text, (data, added, passed) = result
        cache.put_value(key, (text, data, [*added], [(*call,) for call in passed]))
        return result

    return rewrite
