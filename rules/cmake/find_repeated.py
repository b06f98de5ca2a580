"""CM006: a package is looked for once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity

_FIND = "find_package(rclcpp REQUIRED)\n"


class FindRepeated(Rule):
    """``find_package`` looks for the same package twice.

    **Why.** The second call does nothing, and is forgotten when the dependency is removed.

    **Fix.** Remove it.

    **Source.** catkin_lint, "duplicate find_package".
    """

    code = "CM006"
    name = "find-repeated"
    severity = Severity.WARNING
    examples = (
        Example("once", {"CMakeLists.txt": f"project(talker)\n{_FIND}"}),
        Example(
            "twice",
            {"CMakeLists.txt": f"project(talker)\n{_FIND}{_FIND}"},
            Report("3:1", "'rclcpp' is already found in line 2", fix="remove it"),
            fixed={"CMakeLists.txt": f"project(talker)\n{_FIND}"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        first: dict[tuple[str, ...], int] = {}
        for command in cmake.find("find_package"):
            values = tuple(command.values)
            if not values or command.blocks or "$" in values[0]:
                continue
            line = command.location.line
            if values not in first:
                first[values] = line
                continue
            start = cmake.source.offset(line)
            end = cmake.source.offset(command.location.end_line + 1)
            text = cmake.source.text[start:end]
            alone = text.strip() == cmake.source.text[command.start : command.end]
            fix = Fix("remove it", (Edit("CMakeLists.txt", start, end, ""),)) if alone else None
            message = f"{values[0]!r} is already found in line {first[values]}"
            yield self.report(command.name_location, message, fix)
