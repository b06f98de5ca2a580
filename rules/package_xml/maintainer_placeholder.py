"""PX003: somebody maintains the package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import is_placeholder, is_placeholder_address


class MaintainerPlaceholder(Rule):
    """``<maintainer>`` or ``<author>`` has no name, or a placeholder as name or email address.

    **Why.** The build farm writes to this address when the package breaks.

    **Fix.** Write a name and an address that is read.

    **Source.** REP-149, ``<maintainer>``; ``ros2 pkg create`` writes ``@todo.todo``.
    """

    code = "PX003"
    name = "maintainer-placeholder"
    severity = Severity.WARNING
    release_refused = "the build farm writes to this address"
    examples = (
        Example(
            "somebody",
            {
                "package.xml": "<package>\n"
                '  <maintainer email="ada@example.com">Ada Lovelace</maintainer>\n'
                "</package>\n"
            },
        ),
        Example(
            "as written by ros2 pkg create",
            {
                "package.xml": "<package>\n"
                '  <maintainer email="root@todo.todo">root</maintainer>\n'
                "</package>\n"
            },
            Report("2:22", "maintainer email 'root@todo.todo' is a placeholder"),
        ),
        Example(
            "no name",
            {
                "package.xml": "<package>\n"
                '  <maintainer email="ada@example.com"></maintainer>\n'
                "</package>\n"
            },
            Report("2:3", "<maintainer> has no name"),
        ),
        Example(
            "a placeholder for a name",
            {
                "package.xml": "<package>\n"
                '  <maintainer email="ada@example.com">TODO</maintainer>\n'
                "</package>\n"
            },
            Report("2:3", "the name of <maintainer> is a placeholder"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for tag in ("maintainer", "author"):
            for element in package.manifest.all(tag):
                address = element.attributes.get("email")
                if address and is_placeholder_address(address.value):
                    yield self.report(address, f"{tag} email {address.value!r} is a placeholder")
                if not element.text:
                    yield self.report(element, f"<{tag}> has no name")
                elif is_placeholder(element.text):
                    yield self.report(element, f"the name of <{tag}> is a placeholder")
