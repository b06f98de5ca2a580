"""The files for the type checker: those to check and their imports, as rewritten for it."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence

from scaffold.types import passed_types, ty
from scaffold.types.rewriting.added_lines import Extended
from scaffold.types.rewriting.arguments import with_arguments
from scaffold.types.rewriting.mixins import with_nodes_as_self
from scaffold.types.rewritten import Rewrite
from scaffold.types.sources import Source
from scaffold.types.ty import TyDiagnostic

_INVALID = "invalid-syntax"
_LATE_GLOBAL = "prior to global declaration"
"""The error about an added `global` after a use of the name; the types are still right."""
_COPY = "_ros2_"
"""The prefix of the name of a copy of a file."""
_TYPES = "_ros2types_"
"""The prefix of the name of a file that reveals the types that a module passes."""


class Checked:
    """A file to check.

    Args:
        source: The file.
        callers: The other modules that call its functions.
        reached: The file, its callers and everything that they import, by place.
        is_relevant: Whether it is checked even if its callers pass nothing.
    """

    def __init__(
        self,
        source: Source,
        callers: Sequence[Source],
        reached: Mapping[str, Source],
        *,
        is_relevant: bool,
    ) -> None:
        self.source = source
        self.callers = callers
        self.reached = reached
        self.is_relevant = is_relevant


class Project:
    """A run of the type checker over some files; it starts on construction.

    Args:
        directory: Where to write the files.
        environment: The Python environment with the stubs.
        checked: The files to check.
        rewrite: Rewrites a file for the type checker.
        passing: Modules whose passed types are wanted, each with the files that it reaches.
    """

    def __init__(
        self,
        directory: str,
        environment: str,
        checked: Sequence[Checked],
        rewrite: Rewrite,
        passing: Mapping[str, Mapping[str, Source]] | None = None,
    ) -> None:
        self._directory = directory
        self._environment = environment
        self._texts: dict[str, bytes] = {}
        """The files without the lines that are added, by place."""
        self._written: dict[str, Extended] = {}
        self._reported: dict[str, list[TyDiagnostic]] | None = None
        for reached in (*(file.reached for file in checked), *(passing or {}).values()):
            for place, source in reached.items():
                if place not in self._written:
                    self._texts[place], self._written[place] = rewrite(source)
        self._places = {file.source.place: self._place(file) for file in checked}
        places = [
            place
            for file in checked
            for place in (self._places[file.source.place],)
            if file.is_relevant or place != file.source.place
        ]
        places += filter(None, map(self._ask_types, passing or ()))
        _write(directory, ((place, written.data) for place, written in self._written.items()))
        places = places or [*self._places.values()][:1]
        self._run = ty.Run(directory, environment, places) if places else None

    def _place(self, file: Checked) -> str:
        """Return the place where a file is checked; write the argument types into a copy.

        What other files import from it must not depend on its callers.
        """
        source = file.source
        received = [
            call
            for caller in file.callers
            for call in self._written[caller.place].passed
            if call.function.startswith(f"{source.dotted}.")
        ]
        text = self._texts[source.place]
        if not received:
            return source.place
        extended = with_nodes_as_self(with_arguments(text, source.dotted, received))
        if extended.data == self._written[source.place].data:
            return source.place
        place = self._put_next_to(source.place, _COPY, extended)
        self._texts[place] = text
        return place

    def _ask_types(self, place: str) -> str:
        """Write a file that reveals the types that a module passes; return its place."""
        asking = passed_types.revealing(self._written[place].passed)
        return self._put_next_to(place, _TYPES, Extended(asking, ())) if asking else ""

    def _put_next_to(self, place: str, prefix: str, written: Extended) -> str:
        result = _next_to(place, prefix)
        self._written[result] = written
        return result

    def reports(self, file: Checked) -> list[TyDiagnostic]:
        """Return the reports about the user's lines of a file.

        Raises:
            UnavailableError: the type checker fails or hangs.
        """
        place = self._places[file.source.place]
        return [*_of_user(self._results().get(place, ()), self._written[place])]

    def passed_types(self, place: str, reached: Mapping[str, Source]) -> passed_types.Types:
        """Return the types that a module passes; raises UnavailableError."""
        reported = self._results().get(_next_to(place, _TYPES), ())
        return passed_types.types(self._written[place].passed, reported, reached)

    def _results(self) -> Mapping[str, list[TyDiagnostic]]:
        """Return the reports by place; files that added lines break are checked without them."""
        if self._reported is None and self._run is not None:
            self._reported = dict(self._run.results())
            broken = [place for place in self._texts if self._is_broken(place)]
            if broken:
                texts = [(place, self._texts[place]) for place in broken]
                self._written.update((place, Extended(text, ())) for place, text in texts)
                _write(self._directory, texts)
                self._run = ty.Run(self._directory, self._environment, broken)
                self._reported |= {place: [] for place in broken} | dict(self._run.results())
        return self._reported or {}

    def _is_broken(self, place: str) -> bool:
        """Return whether a file does not parse, possibly because of added lines."""
        is_extended = self._written[place].data != self._texts[place]
        reported = (self._reported or {}).get(place, ())
        return is_extended and any(
            item.kind == _INVALID and _LATE_GLOBAL not in item.message for item in reported
        )

    def close(self) -> None:
        """Stop the type checker."""
        if self._run is not None:
            self._run.close()


def _next_to(place: str, prefix: str) -> str:
    folder, _, name = place.rpartition("/")
    return f"{folder}/{prefix}{name}"


def _of_user(diagnostics: Sequence[TyDiagnostic], written: Extended) -> Iterator[TyDiagnostic]:
    """Yield the reports about the user's lines, with the original line numbers."""
    for item in diagnostics:
        line = written.original_line(item.line)
        if line:
            end = written.original_line(item.end_line)
            yield item._replace(line=line, end_line=end)


def _write(project: str, files: Iterable[tuple[str, bytes]]) -> None:
    made: set[str] = set()
    for place, data in files:
        folder = os.path.dirname(place)
        if folder not in made:
            made.add(folder)
            os.makedirs(os.path.join(project, folder), exist_ok=True)
        with open(os.path.join(project, place), "wb") as file:
            file.write(data)
