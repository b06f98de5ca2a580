"""The command lines of programs that launch files start, split into arguments."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.cases import Case
from scaffold.model.launch.evaluation.evaluator import joined_value
from scaffold.model.launch.markup_file import markup_files
from scaffold.model.launch.python_file import NODES, LaunchFile
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.formats.xml import Attribute
    from scaffold.model.package import Package
    from scaffold.source import Location, Source

PROGRAM = "static_transform_publisher"
UNSAID = "$"
"""Placeholder for an unknown value; options are always literal."""
_PROCESSES = ("ExecuteProcess", "ExecuteLocal")
_OF_PROCESSES = "Execute"
"""What the names of these actions have in common."""
_RUN = ["ros2", "run"]
_WORD = lazy_re.compile(r"(?:\$\([^()]*(?:\([^()]*\)[^()]*)*\)|[^\s$]|\$)+")
"""Matches a word of a command line; a substitution is a part of one."""
_FOUND = lazy_re.compile(
    r"\$\(find-exec\s+([^\s()$]+)\s*\)"
)  # linear: spaces and non-spaces alternate


class Word(NamedTuple):
    """An argument of the program."""

    text: str
    location: Location
    node: ast.expr | None = None
    """Its expression, which may give several words."""
    span: tuple[int, int] | None = None
    """Its range in the value of an attribute."""

    @property
    def is_no_number(self) -> bool:
        """Whether ``std::stod`` rejects it, which only reads the start of a text."""
        begins = r"\s*[-+]?(?:\.?[0-9]|inf|nan)"
        return UNSAID not in self.text and not re.match(begins, self.text, re.IGNORECASE)


class CommandLine(NamedTuple):
    """The complete command line of a program."""

    location: Location
    """The place of the action."""
    given: Location
    """The location of the words."""
    words: Sequence[Word]
    launch: LaunchFile | None = None
    expression: ast.expr | None = None
    """The expression of the words in Python."""
    attribute: Attribute | None = None
    """Their attribute in XML and YAML."""


def static_transforms(package: Package) -> Iterator[CommandLine]:
    """Yield the command lines of static_transform_publisher in launch files."""
    return command_lines(package, PROGRAM)


def command_lines(package: Package, program: str) -> Iterator[CommandLine]:
    """Yield the command lines of a program in launch files.

    The words between ``--ros-args`` and ``--`` are skipped.
    """
    for launch in LaunchFile.mentioning(package, program):
        for call in launch.find(*NODES):
            if launch.text(call, "executable") == program:
                for line in _in_python(launch, call, "arguments"):
                    yield line._replace(words=_program_words(line.words))
    for file in markup_files(package):
        for node in file.nodes:
            given = node.arguments
            if node.executable is not None and node.executable.value == program and given:
                words = _program_words(_split(given))
                yield CommandLine(given.location, given.location, words, attribute=given)
    for line in processes(package):
        texts = [word.text for word in line.words[:4]]
        if texts[:2] == _RUN and texts[3:] == [program]:
            yield line._replace(words=_program_words(line.words[4:]))


def processes(package: Package) -> Iterator[CommandLine]:
    """Yield the literal command lines, such as ``ros2 run ...``."""
    for launch in LaunchFile.mentioning(package, _OF_PROCESSES):
        for call in launch.find(*_PROCESSES):
            yield from _in_python(launch, call, "cmd")
    for file in markup_files(package):
        for command in file.commands:
            at = command.location
            yield CommandLine(at, at, _split(command), attribute=command)


def _in_python(launch: LaunchFile, call: LaunchCall, keyword: str) -> Iterator[CommandLine]:
    """Yield the command line of an action, in each case of the functions and loops around it."""
    line = _line(launch, call, keyword, None)
    is_known = line is None or all(UNSAID not in word.text for word in line.words)
    for case in (() if is_known else launch.cases(call.call)) or (None,):
        with launch.evaluator.bound(case.values if case is not None else {}):
            line = _line(launch, call, keyword, case)
        if line is not None:
            yield line


def _line(
    launch: LaunchFile, call: LaunchCall, keyword: str, case: Case | None
) -> CommandLine | None:
    expression = call.given.get(keyword)
    elements = launch.evaluator.elements(expression) if expression is not None else None
    if expression is None or elements is None or not elements.complete or not elements.items:
        return None
    words: list[Word] = []
    is_shell = launch.evaluator.evaluate(call.given.get("shell")) is True
    for item in elements.items:
        text = joined_value(item.value)
        texts = [UNSAID] if not isinstance(text, str) else text.split() if is_shell else [text]
        place = item.node if case is None else case.place(launch.module, item.node)
        node = item.node if len(texts) == 1 and place is item.node else None
        words += [Word(part, launch.location(place), node) for part in texts]
    return CommandLine(call.location, launch.location(expression), words, launch, expression)


def _split(attribute: Attribute) -> list[Word]:
    at = attribute.location
    return [
        Word(_text(match[0]), at, span=match.span()) for match in _WORD.finditer(attribute.value)
    ]


def _text(word: str) -> str:
    """Return a word of markup; for a program found by launch, its name."""
    substitution = _FOUND.fullmatch(word)
    if substitution:
        return substitution[1]
    return UNSAID if "$(" in word else word


def _program_words(words: Sequence[Word]) -> Sequence[Word]:
    """Return the words for the program, without ROS arguments."""
    result: list[Word] = []
    is_for_ros = False
    for word in words:
        if word.text == "--ros-args":
            is_for_ros = True
        elif not is_for_ros:
            result.append(word)
        elif word.text == "--":
            is_for_ros = False
    return result


def start_of_value(source: Source, attribute: Attribute) -> int | None:
    """Return the start of the value of an attribute, after the quote in YAML.

    ``None`` if the text and the value differ, as with escapes.
    """
    start = source.offset(attribute.location.line, attribute.location.column)
    if source.text.startswith(attribute.value, start):
        return start
    quote = source.text[start : start + 1]
    is_quoted = quote in {"'", '"'}
    is_same = source.text.startswith(f"{quote}{attribute.value}{quote}", start)
    return start + 1 if is_quoted and is_same else None
