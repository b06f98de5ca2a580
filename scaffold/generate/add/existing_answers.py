"""What an existing package has decided, as answers to the questions of templates."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from scaffold.ament import copyright as notices
from scaffold.errors import InputError
from scaffold.files.tree import MANIFEST
from scaffold.generate.own_sources import majority, own_headers
from scaffold.generate.questions import answer_types
from scaffold.generate.questions.questions import Given
from scaffold.model.manifest.manifest import Manifest
from scaffold.model.manifest.placeholders import is_placeholder
from scaffold.model.manifest.spdx import spdx_of
from scaffold.model.package import Package

LICENSE_FILE = "LICENSE"
_ACCOUNTS = frozenset({"root", "user", "ubuntu", "ros", "admin", "vscode", "none", "unknown"})
"""Accounts of containers and images, which `ros2 pkg create` takes for the maintainer's name."""
_OF_EXAMPLES = ("open source robotics foundation", "open robotics", "willow garage")
"""Holders named in copied examples and tutorials, and in code ported from ROS 1."""
_OF_OPEN_ROBOTICS = ("openrobotics.org", "osrfoundation.org")


def answers(package: Package, licenses: Sequence[str]) -> dict[str, Given]:
    """Return what a package has decided: its license, copyright holder and maintainer.

    Args:
        package: The package; its manifest can be parsed.
        licenses: The licenses that there are templates for.
    """
    maintainer, address = _maintainer(package.manifest)
    decided = {
        "license": license_of(package, licenses),
        "copyright_holder": _holder(package) or maintainer,
        "maintainer_name": maintainer,
        "maintainer_email": address,
    }
    return {name: Given(value, MANIFEST) for name, value in decided.items() if value is not None}


def license_of(package: Package, templates: Sequence[str]) -> str | None:
    """Return the license of a package that there is a template for.

    The manifest decides; where it says too little (``BSD``) or nothing, the headers of the
    package's own sources do, then the file LICENSE. Where it says TODO nothing is decided.
    """
    if not is_decided(package):
        return None
    declared = [
        spdx_of(element.text) or (element.text,) for element in package.manifest.all("license")
    ]
    choices = {
        spelling for spellings in declared for spelling in spellings if spelling in templates
    }
    if len(choices) == 1:
        return choices.pop()
    written = Counter(
        header.licence for header in own_headers(package) if header.licence in templates
    )
    for licence, _ in written.most_common():
        if licence in choices or not choices:
            return licence
    if package.has(LICENSE_FILE):
        licence = notices.identify_file(LICENSE_FILE, package.tree.read(LICENSE_FILE))
        if licence in templates:
            return licence
    return min(choices, default=None)


def is_decided(package: Package) -> bool:
    """Tell whether the manifest does not leave the license to be filled in."""
    return not any(is_placeholder(element.text) for element in package.manifest.all("license"))


def own_header(package: Package) -> str:
    """Return the comment with the copyright notice that most own Python files begin with.

    It is empty where the license is not decided, or where the files do not agree.
    """
    headers = [header for header in own_headers(package) if header.path.endswith(".py")]
    comments = (
        _comment(package.source(header.path).lines, header.location.line - 1)
        for header in headers
        if any(_may_hold(package, name) for name in header.holders)
    )
    return (majority(comments, len(headers)) or "") if is_decided(package) else ""


def _comment(lines: Sequence[str], number: int) -> str:
    """Return the comment lines around a line."""
    start = end = number
    while start and lines[start - 1].startswith("#") and not lines[start - 1].startswith("#!"):
        start -= 1
    while end < len(lines) and lines[end].startswith("#"):
        end += 1
    return "\n".join(lines[start:end])


def _holder(package: Package) -> str | None:
    """Return the copyright holder of most own sources; those without a notice count, too."""
    headers = own_headers(package)
    names = (name for header in headers for name in {*map(_without_remark, header.holders)})
    holder = majority(names, len(headers))
    if holder is None or not _is_usable(holder) or not _may_hold(package, holder):
        return None
    return holder


def _may_hold(package: Package, name: str) -> bool:
    """Tell whether a notice may be of the package's authors, and not of those they copied from."""
    if not name.lower().startswith(_OF_EXAMPLES):
        return True
    maintainers = package.manifest.all("maintainer")
    return any(
        (maintainer.get("email") or "").endswith(_OF_OPEN_ROBOTICS) for maintainer in maintainers
    )


def _without_remark(name: str) -> str:
    """Return the name of a holder without remarks such as "All rights reserved"."""
    remark = r"[.,]?\s*\b(all rights reserved|see (the )?licen[sc]e)\b.*$"
    return re.sub(remark, "", name, flags=re.IGNORECASE).strip()


def _maintainer(manifest: Manifest) -> tuple[str | None, str | None]:
    """Return the name and the address of the first maintainer, if they can be used."""
    element = manifest.one("maintainer")
    if element is None:
        return None, None
    email = element.get("email") or ""
    try:
        address: str | None = answer_types.address(email)
    except InputError:
        address = None
    is_person = _is_usable(element.text) and not is_placeholder(element.text)
    is_person = is_person and element.text.lower() not in _ACCOUNTS
    return (element.text if is_person else None), address


def _is_usable(name: str) -> bool:
    try:
        return bool(answer_types.person(name))
    except InputError:
        return False
