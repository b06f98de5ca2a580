"""CMakeLists.txt: its commands, found packages and installed files."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from scaffold.model.cmake import parser as cmake_parser
from scaffold.model.cmake.installs import Install, InstallItem, InstallReader, plain_path, shown
from scaffold.model.cmake.lexer import Token
from scaffold.model.cmake.parser import Argument, Command
from scaffold.model.cmake.variables import ROOT, Bindings, Glob, Variables
from scaffold.record import NamedTuple
from scaffold.source import Location, ParseError, Source

__all__ = [
    "Argument",
    "CMakeLists",
    "Command",
    "FoundPackage",
    "Install",
    "InstallItem",
    "Token",
]

FINDS_DEPENDENCIES = frozenset({"ament_auto_find_build_dependencies", "autoware_package"})
"""Commands that find every build dependency of the manifest, or hide one that does."""

LAST_CALLS = ("ament_package", "ament_auto_package", "autoware_ament_auto_package")
"""Commands that register the package: ``ament_package`` and those that call it."""

_MAX_ITEMS = 20_000  # installed items; lists and loops multiply
_MAX_DEPTH = 200  # blocks around a command; deeper ones count as not guarded
_NO_BINDINGS: Bindings = {}


class FoundPackage(NamedTuple):
    """A package named in a call of ``find_package``."""

    name: str
    location: Location
    """The location of the name."""
    command: Command
    required: bool
    in_testing: bool
    """Whether it is only found when tests are built."""


class CMakeLists:
    """A CMakeLists.txt. It is read in full even when it has errors."""

    def __init__(self, source: Source, parsed: cmake_parser.Parsed) -> None:
        self.source = source
        self.tokens = parsed.tokens
        """All tokens; joined they are the file."""
        self.commands = parsed.commands
        """The commands, with those of included files that are known, in the order of CMake."""
        self.errors = parsed.errors
        """The syntax errors, each a location and a message, in file order."""
        self.own_commands = parsed.commands
        """The commands of the file itself."""
        self.followed: frozenset[Command] = frozenset()
        """The calls of ``include`` whose file is known."""
        self._glob: Glob | None = None
        self._project_above: str | None = None

    @classmethod
    def parse(cls, source: Source) -> CMakeLists:
        """Parse a file; errors are collected in ``errors``."""
        return cls(source, cmake_parser.parse(source))

    def splice(self, commands: list[Command], followed: Collection[Command], glob: Glob) -> None:
        """Add the commands of included files, before anything else is asked.

        Args:
            commands: All commands.
            followed: The calls of ``include`` whose file is known.
            glob: Lists the files of the package.
        """
        self.commands = commands
        self.followed = frozenset(followed)
        self._glob = glob
        for cached in ("_by_name", "_variables"):
            self.__dict__.pop(cached, None)

    def place_below(self, project: str | None, glob: Glob) -> None:
        """Make this the file of a subdirectory of a project, before anything else is asked."""
        self._project_above = project
        self._glob = glob

    def require(self) -> None:
        """Raise an error unless the file is valid.

        Raises:
            ParseError: the first error.
        """
        if self.errors:
            raise ParseError(*self.errors[0])

    # -- commands

    def find(self, *names: str) -> list[Command]:
        """Return the calls of some commands, by lower-case names, in the order of the file."""
        if len(names) == 1:
            return self._by_name.get(names[0], [])
        result = [command for name in names for command in self._by_name.get(name, ())]
        return sorted(result, key=lambda command: command.index)

    def is_called(self, command: Command) -> bool:
        """Return whether something calls the function or macro around a command, if any."""
        return all(
            block.name not in {"function", "macro"} or self.find(block.values[0].lower())
            for block in command.blocks
            if block.arguments
        )

    def find_own(self, *names: str) -> list[Command]:
        """Return the calls of some commands, except in included files."""
        return [command for command in self.find(*names) if command.path == self.source.path]

    @property
    def includes_unknown(self) -> bool:
        """Whether an included file is unknown."""
        return not self.followed.issuperset(self.find("include"))

    @cached_property
    def defined(self) -> frozenset[str]:
        """The functions and macros of the file, and of those that it includes, in lower case."""
        definitions = self.find("macro", "function")
        return frozenset(item.values[0].lower() for item in definitions if item.arguments)

    @cached_property
    def _by_name(self) -> Mapping[str, list[Command]]:
        result: dict[str, list[Command]] = {}
        for command in self.commands:
            result.setdefault(command.name, []).append(command)
        return result

    @property
    def comments(self) -> list[Token]:
        """The comments, with the ``#``."""
        return [token for token in self.tokens if token.kind in {"comment", "bracket_comment"}]

    def text(self, token: Token) -> str:
        """Return the text of a token."""
        return self.source.text[token.start : token.end]

    # -- values

    @property
    def project(self) -> Command | None:
        """The first call of ``project``."""
        calls = self.find("project")
        return calls[0] if calls else None

    @cached_property
    def project_name(self) -> str | None:
        """What ``project`` names, with variables replaced."""
        return self.expand("${PROJECT_NAME}")

    @property
    def project_name_location(self) -> Location | None:
        """The place of the name in ``project``."""
        project = self.project
        return project.arguments[0].location if project and project.arguments else None

    @cached_property
    def _variables(self) -> Variables:
        project = self.project
        above = self._project_above
        name = project.arguments[0].text if project and project.arguments else above
        directory = self.source.path.rpartition("/")[0]
        is_below = above is not None and project is None
        return Variables(self.commands, directory, name, self._glob, is_subdirectory=is_below)

    def expand(
        self,
        value: str | Argument,
        at: Command | None = None,
        bindings: Bindings = _NO_BINDINGS,
    ) -> str | None:
        """Replace variables and escapes.

        Args:
            value: An argument, or text as it is written in the file, without quotes.
            at: The command whose argument it is: variables have the values they have there.
            bindings: Values of the variables of loops.

        Returns:
            The value; the root of the package is ``.``. ``None`` when anything is not known.
        """
        if isinstance(value, str):
            expanded = self._variables.evaluate(value, at, bindings)
        elif value.bracket:
            expanded = value.text
        else:
            expanded = self._variables.evaluate(value.text, at, bindings)
        return None if expanded is None else shown(expanded)

    def expand_list(
        self,
        arguments: Iterable[Argument],
        at: Command | None = None,
        bindings: Bindings = _NO_BINDINGS,
    ) -> list[str] | None:
        """Replace variables in arguments and split lists; ``None`` when anything is not known."""
        result: list[str] = []
        for argument in arguments:
            values = self._variables.argument(argument, at, bindings)
            if values is None:
                return None
            result.extend(map(shown, values))
        return result

    def turns(self, command: Command) -> Iterable[Bindings]:
        """Return the bindings in the turns of the loops, and the calls of the function, around it.

        One without bindings if they are unknown; it still has literal arguments.
        """
        return self._variables.combinations(command) or (_NO_BINDINGS,)

    def values_of(self, argument: Argument, command: Command) -> list[str]:
        """Return the known values of an argument in the loops and calls around its command."""
        lists = (self.expand_list([argument], command, turn) for turn in self.turns(command))
        return [*dict.fromkeys(value for values in lists for value in values or ())]

    def where_written(self, command: Command, argument: Argument, value: str | None) -> Argument:
        """Return the argument with a value: that of the ``set`` of a variable, or of a call."""
        if "$" not in argument.raw:
            return argument
        setters = [item for item in self.find("set", "list") if item.index < command.index]
        calls = self.find(*self.defined) if self.defined else []
        for other in (*setters, *calls):
            for item in other.arguments:
                if item.value == value:
                    return item
        return argument

    def path_of(self, value: str) -> str:
        """Return the path, relative to the root of the package, of what ``expand`` returned."""
        return plain_path(value if value.startswith("/") else f"{self._directory}/{value}")

    @cached_property
    def _directory(self) -> str:
        directory = self.source.path.rpartition("/")[0]
        return f"{ROOT}/{directory}" if directory else ROOT

    # -- testing

    def guarded_by_testing(self, command: Command) -> bool:
        """Return whether a command only runs when tests are built: ``if(BUILD_TESTING)``."""
        if any(left.index < command.index for left in self._leaves_without_testing):
            return True
        if command.depth > _MAX_DEPTH:
            return False
        at = command
        while at.parent is not None and at.branch is not None:
            if at.parent.name == "if":
                if at.branch.name == "else":
                    if _asks_for_testing(at.parent) is False:
                        return True
                elif _asks_for_testing(at.branch):
                    return True
            at = at.parent
        return False

    def conditions(self, command: Command) -> Iterator[Sequence[str]]:
        """Yield the conditions around a command; for ``else``, that of its ``if``."""
        at = command if command.depth <= _MAX_DEPTH else None
        while at is not None and at.parent is not None and at.branch is not None:
            if at.parent.name == "if":
                yield (at.parent if at.branch.name == "else" else at.branch).values
            at = at.parent

    def is_for_ros1(self, command: Command) -> bool:
        """Return whether a command runs with ROS 1 only: ``if($ENV{ROS_VERSION} EQUAL 1)``."""
        at = command if command.depth <= _MAX_DEPTH else None
        while at is not None and at.parent is not None and at.branch is not None:
            if at.parent.name == "if":
                asked = at.parent if at.branch.name == "else" else at.branch
                if _asks_for_ros(asked) == ("2" if asked is not at.branch else "1"):
                    return True
            at = at.parent
        return False

    def is_off(self, command: Command) -> bool:
        """Return whether a command only runs if an option is switched on."""
        off = self._options_off
        at = command if off and command.depth <= _MAX_DEPTH else None
        while at is not None and at.parent is not None and at.branch is not None:
            asked = at.branch.values if at.branch.name != "else" else []
            if len(asked) == 1 and asked[0] in off:
                return True
            at = at.parent
        return False

    @cached_property
    def _options_off(self) -> frozenset[str]:
        """The options that are off by default."""
        options = [command.values for command in self.find("option")]
        given = {command.values[0] for command in self.find("set") if command.values}
        return frozenset(
            values[0] for values in options if len(values) > 1 and values[2:] in ([], ["OFF"])
        ).difference(given)

    @cached_property
    def _leaves_without_testing(self) -> list[Command]:
        """The first ``return()`` in an ``if(NOT BUILD_TESTING)`` at the top."""
        for command in self.find("return"):
            branch = command.branch
            at_top = command.depth == 1 and branch is not None and branch.name == "if"
            if at_top and branch is not None and _asks_for_testing(branch) is False:
                return [command]
        return []

    # -- packages

    @cached_property
    def found_packages(self) -> list[FoundPackage]:
        """The packages of ``find_package`` calls, also in a loop over a known list."""
        return list(self._found_packages())

    @property
    def finds_automatically(self) -> bool:
        """Whether one command finds every build dependency of the manifest."""
        return any(self.find(name) for name in FINDS_DEPENDENCIES)

    @property
    def finds_tests_automatically(self) -> bool:
        """Whether one command finds every test dependency of the manifest."""
        return bool(self.find("ament_auto_find_test_dependencies"))

    def finds(self, name: str) -> bool:
        """Return whether a package is found by name."""
        return any(package.name == name for package in self.found_packages)

    @property
    def has_unknown_packages(self) -> bool:
        """Whether the name of a package is unknown."""
        return any(
            self.expand(command.arguments[0], command, turn) is None
            for command in self.find("find_package")
            if command.arguments
            for turn in self.turns(command)
        )

    def _found_packages(self) -> Iterator[FoundPackage]:
        for command in self.find("find_package"):
            if not command.arguments or self.is_for_ros1(command):
                continue
            argument = command.arguments[0]
            required = command.has("REQUIRED")
            in_testing = self.guarded_by_testing(command)
            seen: set[str] = set()
            for bindings in self._variables.combinations(command) or ():
                name = self.expand(argument, command, bindings)
                if name and name not in seen:
                    seen.add(name)
                    yield FoundPackage(name, argument.location, command, required, in_testing)

    # -- installation

    @cached_property
    def installs(self) -> list[Install]:
        """The installed items of ``install``, ``ament_auto_package`` and similar commands."""
        result: list[Install] = []
        items = 0
        reader = InstallReader(self._variables, self._directory, self.project_name)
        for command in self.find("install", *LAST_CALLS[1:]):
            if self.is_for_ros1(command):
                continue
            for bindings in self.turns(command):
                if items > _MAX_ITEMS:
                    return result
                result.extend(reader.read(command, bindings))
                items += len(result[-1].items) if result else 0
        return result


def _asks_for_testing(condition: Command) -> bool | None:
    """Return whether a condition requires (true) or excludes (false) tests; else ``None``."""
    values = condition.values
    for number, value in enumerate(values):
        if value in {"BUILD_TESTING", "${BUILD_TESTING}"}:
            return values[number - 1] != "NOT" if number else True
    return None


def _asks_for_ros(condition: Command) -> str | None:
    """Return the version of ROS that a condition tests, if it tests nothing else."""
    match condition.values:
        case [variable, "EQUAL" | "STREQUAL", version] if "ROS_VERSION" in variable:
            return version
        case ["catkin_FOUND"]:
            return "1"
        case _:
            return None
