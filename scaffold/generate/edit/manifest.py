"""Adds dependencies and groups to package.xml."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.edits import Edit
from scaffold.generate.edit.addition import Addition, Outcome, spliced
from scaffold.model.manifest import edit as manifest_edit
from scaffold.model.manifest.manifest import Manifest
from scaffold.source import Source

_TAGS = {
    "buildtool": ("build",),
    "build": ("build",),
    "build_export": ("build_export",),
    "exec": ("run",),
    "depend": ("build", "build_export", "run"),
}
"""The kinds of dependencies, and the phases in which each must be available."""
_FOR_TESTS = ("build", "run", "test")
"""The kinds of dependencies that are available when tests run."""
_SINGLE = {"build": "build_depend", "build_export": "build_export_depend", "run": "exec_depend"}
_FIRST_WITH_EXEC = 2
"""The format that introduced ``exec_depend`` and ``depend``."""
_BEFORE_EXEC = ("depend", "build_export_depend", "build_depend", "buildtool_depend")
"""The elements to insert a first ``exec_depend`` after, best first."""


def add_to_manifest(source: Source, addition: Addition) -> Outcome:
    """Declare the dependencies of an addition next to their kind, unless they are covered already.

    Raises:
        ParseError: the manifest is not well-formed.
    """
    for kind, names in addition.depends.items():
        for name in names:
            if name != addition.package:
                source = _declare(source, kind, name)
    for group in addition.groups:
        manifest = Manifest.parse(source)
        if not manifest.member_of(group):
            source = spliced(source, [manifest.insert("member_of_group", group)])
    return Outcome(source)


def _declare(source: Source, kind: str, name: str) -> Source:
    for tag in _missing(Manifest.parse(source), kind, name):
        manifest = Manifest.parse(source)
        source = spliced(source, [_insertion(manifest, tag, name)])
    return source


def _missing(manifest: Manifest, kind: str, name: str) -> Iterator[str]:
    """Yield the tags that declare a need which is not declared yet."""
    if kind == "test":
        if name not in manifest.names_for(*_FOR_TESTS):
            yield "test_depend"
        return
    missing = [purpose for purpose in _TAGS[kind] if name not in manifest.names_for(purpose)]
    if not missing:
        return
    if manifest.format < _FIRST_WITH_EXEC:
        old = {"build": "build_depend", "build_export": "run_depend", "run": "run_depend"}
        yield from dict.fromkeys(old[purpose] for purpose in missing if kind != "buildtool")
        if kind == "buildtool":
            yield "buildtool_depend"
    elif kind == "buildtool":
        yield "buildtool_depend"
    elif len(missing) == len(_TAGS["depend"]):
        yield "depend"
    else:
        yield from (_SINGLE[purpose] for purpose in missing)


def _insertion(manifest: Manifest, tag: str, name: str) -> Edit:
    """Return the edit that adds a dependency; the first ``exec_depend`` comes below the others."""
    if tag == "exec_depend" and manifest.one(tag) is None:
        for other in _BEFORE_EXEC:
            elements = manifest.all(other)
            if elements:
                return manifest_edit.insert_after(
                    manifest.document, elements[-1], manifest_edit.render(tag, name)
                )
    return manifest.insert(tag, name)
