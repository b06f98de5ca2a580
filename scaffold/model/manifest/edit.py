"""Edits of package.xml that keep everything else of the file as it is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise

from scaffold.edits import Edit
from scaffold.formats.xml import Document, Element
from scaffold.model.manifest.tags import DEPENDENCY_TAGS
from scaffold.record import NamedTuple

SCHEMA = "http://download.ros.org/schema/package_format{}.xsd"
_DEPENDENCIES = (*DEPENDENCY_TAGS, "conflict", "replace")
_ORDER: tuple[tuple[str, ...], ...] = (
    ("name",),
    ("version",),
    ("description",),
    ("maintainer",),
    ("license",),
    ("url",),
    ("author",),
    _DEPENDENCIES,
    ("group_depend",),
    ("member_of_group",),
    ("export",),
)
_SECTION = {tag: number for number, tags in enumerate(_ORDER) for tag in tags}


def section(tag: str) -> int | None:
    """Return the index of the section of a tag, in schema order."""
    return _SECTION.get(tag)


def insert(
    document: Document, tag: str, text: str, attributes: Mapping[str, str] | None = None
) -> Edit:
    """Add an element below the root: in sorted order within its group, else in schema order."""
    return place(document, tag, text, render(tag, text, attributes))


def insert_after(document: Document, element: Element, markup: str) -> Edit:
    """Add markup after an element, on a separate line if the element has one."""
    return _insert_after(document, element, markup)


def _insert_into(document: Document, parent: Element, markup: str) -> Edit:
    """Add markup as the last child of an element."""
    source = document.source
    children = parent.children
    if children:
        return _insert_after(document, children[-1], markup)
    outer = _indent_of(document, parent)
    unit = _indentation(document)
    body = f"{source.newline}{outer}{unit}{markup}{source.newline}{outer}"
    if parent.is_empty_tag:
        opened = source.text[parent.start : parent.open_end - 2].rstrip()
        text = f"{opened}>{body}</{parent.tag}>"
        return Edit(source.path, parent.start, parent.end, text)
    if source.text[parent.open_end : parent.close_start].strip():
        return Edit(source.path, parent.close_start, parent.close_start, markup)
    return Edit(source.path, parent.open_end, parent.close_start, body)


def remove(document: Document, element: Element) -> Edit:
    """Remove an element, with its line and the comment after it when it is alone there."""
    text = document.source.text
    start, end = element.start, _rest_of_line(document, element) or element.end
    line_start = text.rfind("\n", 0, start) + 1
    line_end = text.find("\n", end)
    line_end = len(text) if line_end < 0 else line_end + 1
    if not text[line_start:start].strip() and not text[end:line_end].strip():
        return Edit(document.source.path, line_start, line_end, "")
    end = element.end
    while start > line_start and text[start - 1] in " \t" and text[end : end + 1] in {" ", "\t"}:
        start -= 1
    return Edit(document.source.path, start, end, "")


def reorder(document: Document) -> Edit | None:
    """Sort the children of the root in the order of the schema.

    Comments and blank lines move with the element that they precede. ``None`` when the order
    is right, or when text between the elements makes a move unsafe.
    """
    source, root = document.source, document.root
    chunks: list[tuple[int, str]] = []
    number, at = 0, root.open_end
    for child in root.children:
        end = _rest_of_line(document, child) or child.end
        number = _SECTION.get(child.tag, number)
        chunks.append((number, source.text[at:end]))
        at = end
    in_order = sorted(chunks, key=lambda chunk: chunk[0])
    if in_order == chunks or root.own_text:
        return None
    first = next(i for i, pair in enumerate(zip(chunks, in_order, strict=True)) if len({*pair}) > 1)
    start = root.open_end + sum(len(text) for _, text in chunks[:first])
    return Edit(source.path, start, at, "".join(text for _, text in in_order[first:]))


class InsertedDependency(NamedTuple):
    """An inserted dependency on a separate line."""

    name: str
    rank: int
    """The customary position of its tag."""
    is_before: bool
    """Whether the line is inserted before another one, not after it."""


def inserted_dependency(edit: Edit) -> InsertedDependency | None:
    """Return the dependency that an edit inserts on a separate line, else ``None``."""
    import re

    inserted = re.fullmatch(r"(\s*)<([a-z_]+)(?:\s[^<>]*)?>([^<>]+)</\2>(\s*)", edit.text)
    if inserted is None or inserted[2] not in _DEPENDENCIES:
        return None
    ahead, after = ("\n" in inserted[1], "\n" in inserted[4])
    if ahead == after:
        return None
    return InsertedDependency(inserted[3].strip(), _custom(inserted[2]), is_before=after)


def rename(document: Document, element: Element, tag: str) -> tuple[Edit, ...]:
    """Return the edits that change the tag of an element."""
    path = document.source.path
    start = element.start + 1
    edits = [Edit(path, start, start + len(element.tag), tag)]
    if not element.is_empty_tag:
        start = element.close_start + 2
        edits.append(Edit(path, start, start + len(element.tag), tag))
    return tuple(edits)


def render(tag: str, text: str, attributes: Mapping[str, str] | None = None) -> str:
    """Return the markup of an element."""
    written = "".join(
        f' {name}="{escape(value, chr(34))}"' for name, value in (attributes or {}).items()
    )
    return f"<{tag}{written}>{escape(text)}</{tag}>" if text else f"<{tag}{written}/>"


def escape(text: str, quote: str = "") -> str:
    """Escape text for XML."""
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return text.replace('"', "&quot;") if quote == '"' else text


def place(document: Document, tag: str, text: str, markup: str) -> Edit:
    """Add the markup of an element below the root, where it belongs."""
    children = document.root.children
    run = _last_run(children, tag)
    if run:
        texts = [element.text for element in run]
        if all(item <= two for item, two in pairwise(texts)):
            for element in run:
                if element.text > text:
                    return _insert_before(document, element, markup)
        return _insert_after(document, run[-1], markup)
    anchor = _predecessor(children, tag)
    if anchor is not None:
        return _insert_after(document, anchor, markup)
    if children:
        return _insert_before(document, children[0], markup)
    return _insert_into(document, document.root, markup)


def _last_run(children: Sequence[Element], tag: str) -> list[Element]:
    run: list[Element] = []
    for child in reversed(children):
        if child.tag == tag:
            run.append(child)
        elif run:
            break
    return run[::-1]


def _predecessor(children: Sequence[Element], tag: str) -> Element | None:
    """Return the last element that must, or by custom does, precede a new one."""
    own = _SECTION.get(tag, len(_ORDER))
    result: Element | None = None
    for child in children:
        number = _SECTION.get(child.tag, -1)
        if number < own or (number == own and _custom(child.tag) <= _custom(tag)):
            result = child
    return result


def _custom(tag: str) -> int:
    return _DEPENDENCIES.index(tag) if tag in _DEPENDENCIES else 0


def _insert_after(document: Document, element: Element, markup: str) -> Edit:
    source = document.source
    at = _rest_of_line(document, element)
    if at is None:
        return Edit(source.path, element.end, element.end, markup)
    text = f"{source.newline}{_indent_of(document, element)}{markup}"
    return Edit(source.path, at, at, text)


def _insert_before(document: Document, element: Element, markup: str) -> Edit:
    source = document.source
    at = element.start
    first = source.text.rfind("\n", 0, at) + 1
    if source.text[first:at].strip(" \t") or not first:
        return Edit(source.path, at, at, markup)
    return Edit(source.path, at, at, f"{markup}{source.newline}{source.text[first:at]}")


def _rest_of_line(document: Document, element: Element) -> int | None:
    """Return the end of the line of an element, after comments; None if more markup follows."""
    text = document.source.text
    at = element.end
    comments = {comment.start: comment.end for comment in document.comments}
    behind = at
    while at < len(text):
        if text[at] in " \t":
            at += 1
        elif text[at] in "\r\n":
            return behind
        elif at in comments and "\n" not in text[at : comments[at]]:
            at = behind = comments[at]
        elif at in comments:
            return element.end
        else:
            return None
    return behind


def _indent_of(document: Document, element: Element) -> str:
    """Return the indentation of the line that an element begins on."""
    text = document.source.text
    first = text.rfind("\n", 0, element.start) + 1
    line = text[first : element.start]
    return line[: len(line) - len(line.lstrip(" \t"))]


def _indentation(document: Document) -> str:
    """Return the indentation of one level in this file."""
    outer = _indent_of(document, document.root)
    for child in document.root.children:
        inner = _indent_of(document, child)
        if len(inner) > len(outer) and inner.startswith(outer):
            return inner[len(outer) :]
    return "  "
