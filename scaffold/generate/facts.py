"""What an existing package says of itself, as answers to the questions of templates."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from scaffold.errors import InputError
from scaffold.generate import values
from scaffold.generate.questions import Given
from scaffold.model import copyright as notices
from scaffold.model.manifest import Manifest
from scaffold.model.package import Package
from scaffold.model.spdx import spdx_of
from scaffold.model.tree import MANIFEST

LICENSE_FILE = "LICENSE"


def answers(package: Package, licenses: Sequence[str]) -> dict[str, Given]:
    """Return what a package has decided: its licence, copyright holder and maintainer.

    Args:
        package: The package; its manifest can be parsed.
        licenses: The licences that there are templates for.
    """
    maintainer, address = _maintainer(package.manifest)
    found = {
        "license": license_of(package, licenses),
        "copyright_holder": _holder(package) or maintainer,
        "maintainer_name": maintainer,
        "maintainer_email": address,
    }
    return {name: Given(value, MANIFEST) for name, value in found.items() if value is not None}


def license_of(package: Package, known: Sequence[str]) -> str | None:
    """Return the licence of a package that there is a template for.

    The manifest decides; where it says too little (``BSD``) or nothing, the headers of the
    sources do, then the file LICENSE.
    """
    declared = [
        spdx_of(element.text) or (element.text,) for element in package.manifest.all("license")
    ]
    choices = {one for spellings in declared for one in spellings if one in known}
    if len(choices) == 1:
        return choices.pop()
    written = Counter(
        header.licence for header in notices.headers(package) if header.licence in known
    )
    for licence, _ in written.most_common():
        if licence in choices or not choices:
            return licence
    if package.has(LICENSE_FILE):
        licence = notices.identify_file(LICENSE_FILE, package.tree.read(LICENSE_FILE))
        if licence in known:
            return licence
    return min(choices, default=None)


def own_header(package: Package) -> str:
    """Return the comment with the copyright notice that most Python files begin with."""
    found: Counter[str] = Counter()
    for header in notices.headers(package):
        if header.holders and header.path.endswith(".py"):
            found[_comment(package.source(header.path).lines, header.location.line - 1)] += 1
    return found.most_common(1)[0][0] if found else ""


def _comment(lines: Sequence[str], number: int) -> str:
    """Return the comment lines around a line."""
    start = end = number
    while start and lines[start - 1].startswith("#") and not lines[start - 1].startswith("#!"):
        start -= 1
    while end < len(lines) and lines[end].startswith("#"):
        end += 1
    return "\n".join(lines[start:end])


def _holder(package: Package) -> str | None:
    """Return who holds the copyright of most sources."""
    names = Counter(
        re.sub(r"[.,]?\s*all rights reserved\.?$", "", name, flags=re.IGNORECASE).strip()
        for header in notices.headers(package)
        for name in header.holders
    )
    for name, _ in names.most_common():
        if _is_usable(name):
            return name
    return None


def _maintainer(manifest: Manifest) -> tuple[str | None, str | None]:
    """Return the name and the address of the first maintainer, if they can be used."""
    element = manifest.one("maintainer")
    if element is None:
        return None, None
    email = element.get("email") or ""
    try:
        address: str | None = values.address(email)
    except InputError:
        address = None
    return (element.text if _is_usable(element.text) else None), address


def _is_usable(name: str) -> bool:
    try:
        return bool(values.person(name))
    except InputError:
        return False
