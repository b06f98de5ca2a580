"""PX001: package.xml has a description, a maintainer and a license."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.formats import Element
from scaffold.api.manifest import is_placeholder, is_placeholder_address

_PERSON = '<package>\n  <maintainer email="{}">{}</maintainer>\n</package>\n'


class ManifestPlaceholder(Rule):
    """``<license>``, ``<description>`` or ``<maintainer>`` is empty or a placeholder.

    **Why.** Without a license, nobody may use the package; catkin_pkg, and therefore colcon and
    bloom, rejects an empty license or description. The description becomes the description of the
    Debian package, and the build farm notifies the maintainer when the build fails.

    **Fix.** Write an SPDX identifier such as ``Apache-2.0``, a sentence about the package, and the
    name and email address of the maintainer. No automatic fix: only the author can decide.

    **Source.** REP 149; ``catkin_pkg.package.Package.validate``; rosdistro review guidelines;
    ``ros2 pkg create`` writes ``TODO`` and ``@todo.todo``.
    """

    code = "PX001"
    name = "manifest-placeholder"
    severity = Severity.WARNING
    other_severities = {
        Severity.ERROR: "the license or description is empty: the package is not built"
    }
    release_refused = "its license, purpose or maintainer would be unknown"
    examples = (
        Example(
            "all three",
            {
                "package.xml": "<package>\n"
                "  <description>Talks.</description>\n"
                '  <maintainer email="ada@example.com">Ada Lovelace</maintainer>\n'
                "  <license>Apache-2.0</license>\n"
                "</package>\n"
            },
        ),
        Example(
            "as written by ros2 pkg create",
            {
                "package.xml": "<package>\n"
                "  <description>TODO: Package description</description>\n"
                '  <maintainer email="root@todo.todo">root</maintainer>\n'
                "  <license>TODO: License declaration</license>\n"
                "</package>\n"
            },
            "2:3: <description> is a placeholder, 'TODO: Package description'",
            "3:22: maintainer email 'root@todo.todo' is a placeholder",
            "4:12: <license> is a placeholder, 'TODO: License declaration': nobody may use the "
            "package",
        ),
        Example(
            "empty",
            {
                "package.xml": "<package>\n"
                "  <description> </description>\n"
                "  <license> </license>\n"
                "</package>\n"
            },
            Report(
                "2:3", "<description> is empty: colcon rejects the package", severity=Severity.ERROR
            ),
            Report(
                "3:3", "<license> is empty: colcon rejects the package", severity=Severity.ERROR
            ),
        ),
        Example(
            "no name",
            {"package.xml": _PERSON.format("ada@example.com", "")},
            "2:3: <maintainer> has no name",
        ),
        Example(
            "a placeholder for a name",
            {"package.xml": _PERSON.format("ada@example.com", "TODO")},
            "2:3: the name of <maintainer> is a placeholder",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for tag in ("license", "description"):
            for element in package.manifest.all(tag):
                yield from self._check_text(element)
        for tag in ("maintainer", "author"):
            for element in package.manifest.all(tag):
                yield from self._check_person(element)

    def _check_text(self, element: Element) -> Iterator[Diagnostic]:
        if not element.text:
            message = f"<{element.tag}> is empty: colcon rejects the package"
            yield self.report(element, message, severity=Severity.ERROR)
        elif is_placeholder(element.text):
            message = f"<{element.tag}> is a placeholder, {element.text!r}"
            if element.tag == "license":
                message = f"{message}: nobody may use the package"
                yield self.report(element.text_location, message)
            else:
                yield self.report(element, message)

    def _check_person(self, element: Element) -> Iterator[Diagnostic]:
        address = element.attributes.get("email")
        if address and is_placeholder_address(address.value):
            yield self.report(address, f"{element.tag} email {address.value!r} is a placeholder")
        if not element.text:
            yield self.report(element, f"<{element.tag}> has no name")
        elif is_placeholder(element.text):
            yield self.report(element, f"the name of <{element.tag}> is a placeholder")
