"""PX083: the LICENSE file contains the license in package.xml."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, Rule, Severity

_TEXTS: Mapping[str, tuple[str, ...]] = {
    "apache": ("apache license", "version 2.0"),
    "mit": ("permission is hereby granted, free of charge", 'the software is provided "as is"'),
    "bsd": ("redistribution and use in source and binary forms",),
    "gpl": ("gnu general public license",),
    "lgpl": ("gnu lesser general public license",),
    "mpl": ("mozilla public license",),
}
"""Phrases in the text of a license, by family."""
_MANIFEST = '<package format="3">\n  <name>talker</name>\n  <license>{}</license>\n</package>\n'
_FILE = {"LICENSE": "                 Apache License\n           Version 2.0, January 2004\n"}


class LicenseDiffers(Rule):
    """The license in package.xml differs from the LICENSE file of the package.

    **Why.** Users find two different licenses; release reviewers reject the package.

    **Fix.** Declare the license of the file.

    **Source.** REP 149, ``license``; ROS 2 documentation, "Indexing your packages".
    """

    code = "PX083"
    name = "license-differs"
    severity = Severity.WARNING
    examples = (
        Example("the same", {**_FILE, "package.xml": _MANIFEST.format("Apache-2.0")}),
        Example(
            "the GPL, whose text mentions the LGPL",
            {
                "LICENSE": "GNU GENERAL PUBLIC LICENSE\n... GNU Lesser General Public License.\n",
                "package.xml": _MANIFEST.format("GPL-3.0-only"),
            },
        ),
        Example(
            "another license",
            {**_FILE, "package.xml": _MANIFEST.format("MIT")},
            "package.xml:3:3: package.xml declares 'MIT', but LICENSE contains the Apache License "
            "2.0; declare the license of the file",
        ),
        Example(
            "the MIT License in LICENSE",
            {
                "LICENSE": "Permission is hereby granted, free of charge\n"
                'The software is provided "as is"\n',
                "package.xml": _MANIFEST.format("Apache-2.0"),
            },
            "package.xml:3:3: package.xml declares 'Apache-2.0', but LICENSE contains the MIT "
            "License; declare the license of the file",
        ),
        Example(
            "a BSD license in LICENSE",
            {
                "LICENSE": "Redistribution and use in source and binary forms\n",
                "package.xml": _MANIFEST.format("MIT"),
            },
            "package.xml:3:3: package.xml declares 'MIT', but LICENSE contains a BSD license; "
            "declare the license of the file",
        ),
        Example(
            "the GPL in LICENSE",
            {
                "LICENSE": "GNU GENERAL PUBLIC LICENSE\n",
                "package.xml": _MANIFEST.format("BSD-3-Clause"),
            },
            "package.xml:3:3: package.xml declares 'BSD-3-Clause', but LICENSE contains the GNU "
            "GPL; declare the license of the file",
        ),
        Example(
            "the LGPL in LICENSE",
            {
                "LICENSE": "GNU LESSER GENERAL PUBLIC LICENSE\n... GNU General Public License.\n",
                "package.xml": _MANIFEST.format("MIT"),
            },
            "package.xml:3:3: package.xml declares 'MIT', but LICENSE contains the GNU LGPL; "
            "declare the license of the file",
        ),
        Example(
            "the Mozilla Public License in LICENSE",
            {
                "LICENSE": "Mozilla Public License Version 2.0\n",
                "package.xml": _MANIFEST.format("MIT"),
            },
            "package.xml:3:3: package.xml declares 'MIT', but LICENSE contains the Mozilla Public "
            "License; declare the license of the file",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        licenses = package.manifest.all("license")
        if len(licenses) != 1 or not package.has("LICENSE"):
            return
        text = " ".join(package.source("LICENSE").text.lower().split())
        matching = {name for name, parts in _TEXTS.items() if all(part in text for part in parts)}
        named = _family(licenses[0].text)
        if {"gpl", "lgpl"} <= matching:  # each mentions the other, but the title comes first
            matching.remove(max("gpl", "lgpl", key=lambda name: text.index(_TEXTS[name][0])))
        if named and len(matching) == 1 and named not in matching:
            held = matching.pop()
            message = (
                f"package.xml declares {licenses[0].text!r}, but LICENSE contains "
                f"{_NAMES[held]}; declare the license of the file"
            )
            yield self.report(licenses[0], message)


_NAMES = {
    "apache": "the Apache License 2.0",
    "mit": "the MIT License",
    "bsd": "a BSD license",
    "gpl": "the GNU GPL",
    "lgpl": "the GNU LGPL",
    "mpl": "the Mozilla Public License",
}


def _family(name: str) -> str:
    """Return the family of a declared license, or nothing."""
    text = name.lower()
    if " or " in text or " and " in text or "/" in text or "," in text:
        return ""
    return next((item for item in ("apache", "lgpl", "gpl", "bsd", "mpl") if item in text), "") or (
        "mit" if text.startswith("mit") else ""
    )
