"""The codes for what ament_xmllint reports."""

from __future__ import annotations

from scaffold.ament.codes.code import XMLLINT, AmentCode
from scaffold.diagnostic import Severity
from scaffold.edits import Safety

ROWS = (
    AmentCode(
        "PX050",
        "xml-not-well-formed",
        "An XML file other than package.xml cannot be read",
        XMLLINT,
        Severity.ERROR,
        message=("</node> expected, <node> opened at line 2 is not closed"),
        other_severities={
            Severity.WARNING: "an empty file, where no test of the package runs ament_xmllint"
        },
        documentation="""\
**Why.** Whoever loads it (launch, a plugin loader, robot_state_publisher) stops there, and
``ament_xmllint`` fails under ``colcon test``. For package.xml itself SC001 says so.

**Fix.** Correct the markup at the place shown; a reader stops at the first mistake.

**Source.** ``ament_xmllint/main.py``; libxml2's limits on depth and length of text.
""",
    ),
    AmentCode(
        "PX051",
        "xml-schema-not-met",
        "An XML file other than package.xml does not fit the schema that it names",
        XMLLINT,
        message=(
            "does not fit a.xsd: Element 'nod': This element is not expected. Expected is ( node )"
        ),
        documentation="""\
**Why.** ``ament_xmllint`` validates every file that names a schema, and fails under
``colcon test``; also when the schema is not there.

**Fix.** Correct the file, or the place of the schema. For schemas that are
not checked, see PX052.

**Source.** ``ament_xmllint/main.py``.
""",
    ),
    AmentCode(
        "PX052",
        "xml-schema-unchecked",
        "Whether an XML file fits the schema that it names is not checked",
        XMLLINT,
        Severity.INFO,
        message=("names the schema 'a.xsd', which is not checked: it includes other files"),
        documentation="""\
**Why.** ``ament_xmllint`` validates the file under ``colcon test``, so it may fail there
although nothing is reported here. A check neither fetches anything nor lets a schema open
further files, and it ends a schema that takes more than some seconds.

**Fix.** None is needed; run ``ament_xmllint`` to know. A schema that is one file of the
package is checked.

**Source.** ``ament_xmllint/main.py``.
""",
    ),
    AmentCode(
        "PX060",
        "element-misplaced",
        "An element of package.xml is where the schema does not allow it",
        XMLLINT,
        fix=Safety.SAFE,
        message=("<author> must come after <license> in line 7 and before <depend> in line 8"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, with a message that names the element
after the wrong one.

**Fix.** Put the elements in the order name, version, description, maintainer, license, url,
author, dependencies, group_depend, member_of_group, export. Comments go with the element that
they precede; where there are any, the author should look at the result.

**Source.** The schemas ``package_format1.xsd`` to ``package_format3.xsd``; REP 149.
""",
    ),
    AmentCode(
        "PX061",
        "element-unknown",
        "package.xml has an element that its format does not know",
        XMLLINT,
        Severity.ERROR,
        fix=Safety.UNSAFE,
        message=("<run_depend> is of format 1: in format 3 it is <exec_depend>"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Use the element of this format: ``<exec_depend>`` instead of ``<run_depend>`` since
format 2, or declare the later format.

**Source.** REP 127, REP 140, REP 149; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX062",
        "element-missing",
        "package.xml lacks a name, version, description, maintainer or license",
        XMLLINT,
        Severity.ERROR,
        message=("no <license>: every manifest has one, after <maintainer>"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Add the element. No automatic fix: the author has to say what is in it.

**Source.** REP 149, "Required tags"; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX063",
        "element-repeated",
        "package.xml has a second name, version, description or export",
        XMLLINT,
        Severity.ERROR,
        fix=Safety.SAFE,
        message=("a second <name>: the first is in line 2"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Keep one; put everything that is exported into one ``<export>``.

**Source.** REP 149; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX064",
        "attribute-unknown",
        "An element of package.xml has an attribute that its format does not know",
        XMLLINT,
        Severity.ERROR,
        message=("<version compatibility> is in REP 149, but ament_xmllint's schema rejects it"),
        documentation="""\
**Why.** colcon refuses the manifest, or ``ament_xmllint`` fails under ``colcon test``.

**Fix.** Correct the name or remove the attribute.

**Source.** REP 127, REP 140, REP 149 and their schemas. ``<version compatibility>`` is in
REP 149 but not in the schema of format 3, so the linter refuses it.
""",
    ),
    AmentCode(
        "PX065",
        "format-differs",
        "``format`` is not 1, 2 or 3, or the ``<?xml-model?>`` line names another one",
        XMLLINT,
        Severity.ERROR,
        fix=Safety.SAFE,
        message=("names the schema of format 2, but <package> has 3"),
        other_severities={
            Severity.WARNING: "the two differ, and no test of the package runs ament_xmllint"
        },
        documentation="""\
**Why.** colcon reads ``format`` and refuses one it does not know; ``ament_xmllint`` reads the
schema and fails under ``colcon test`` when the two differ. Without ``format`` it is 1.

**Fix.** Write the same number in both; 3 is the format of ROS 2.

**Source.** REP 149; ``catkin_pkg/package.py``; ``ament_xmllint/main.py``.
""",
    ),
    AmentCode(
        "PX066",
        "text-between-elements",
        "Text between the elements of package.xml, or directly in ``<export>``",
        XMLLINT,
        message=("text between the elements: only comments are allowed"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``; everybody else ignores the text, which
is mostly the rest of an element or of a comment.

**Fix.** Remove the text, or make a comment of it.

**Source.** The schemas ``package_format1.xsd`` to ``package_format3.xsd``.
""",
    ),
    AmentCode(
        "PX067",
        "name-malformed",
        "The name of the package has characters that a name may not have",
        XMLLINT,
        Severity.ERROR,
        other_severities={
            Severity.WARNING: "colcon accepts the name, the package has no interfaces, and none of "
            "its tests runs ament_xmllint"
        },
        message=("the name 'Talker-two' has - in it: only a to z, 0 to 9 and _ are allowed"),
        documentation="""\
**Why.** colcon refuses names with other characters, interfaces are only generated for well-formed
names, and ``ament_xmllint`` fails under ``colcon test``. Names with a capital cannot be released.

**Fix.** Use lower-case letters, digits and single underscores between them, a letter first.
No automatic fix: the name is in other files, too.

**Source.** REP 144; REP 149, ``<name>``; the schemas; ``catkin_pkg/package.py``;
``rosidl_adapter/parser.py``.
""",
    ),
    AmentCode(
        "PX068",
        "version-malformed",
        "The version of the package is not three numbers with dots between them",
        XMLLINT,
        Severity.ERROR,
        message=("the version '0.1' is not MAJOR.MINOR.PATCH"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else. A
number with a leading zero fails in ``ament_xmllint`` only.

**Fix.** Write ``MAJOR.MINOR.PATCH`` such as ``0.1.0``.

**Source.** REP 149, ``<version>``; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX069",
        "url-type-unknown",
        "``<url type>`` is none of website, bugtracker and repository",
        XMLLINT,
        message=("the url type 'homepage' is not known, only website, bugtracker, repository"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, and the index of packages shows no
link.

**Fix.** Use one of the three; without ``type`` it is a website.

**Source.** REP 149, ``<url>``; the schemas.
""",
    ),
    AmentCode(
        "PX070",
        "dependency-version-malformed",
        "``version_gte`` or alike of a dependency is not one to three numbers",
        XMLLINT,
        release_refused="the Debian package cannot ask for such a version",
        message=('version_gte="1.x" is not one to three numbers'),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, and bloom writes a wrong dependency
into the release.

**Fix.** Write ``1``, ``1.2`` or ``1.2.3``.

**Source.** REP 149, "Dependency tags"; the schemas.
""",
    ),
    AmentCode(
        "PX071",
        "condition-misplaced",
        "A ``condition`` is where its format has none, or has characters that are not allowed",
        XMLLINT,
        Severity.ERROR,
        message=("conditions need format 3, but this manifest has format 2"),
        documentation="""\
**Why.** colcon refuses the manifest, or ``ament_xmllint`` fails under ``colcon test``.

**Fix.** Declare format 3; only dependencies and groups have conditions. Those of groups take
no quotes in the schema: write the bare word.

**Source.** REP 149, "Conditions"; ``package_format3.xsd``.
""",
    ),
    AmentCode(
        "PX072",
        "email-missing",
        "A ``<maintainer>`` has no e-mail address",
        XMLLINT,
        Severity.ERROR,
        message=("the maintainer 'A' has no email"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Add ``email="..."``. No automatic fix: the tool does not know the address.

**Source.** REP 149, ``<maintainer>``; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX073",
        "email-malformed",
        "The email address of a maintainer or author is not an address",
        XMLLINT,
        Severity.ERROR,
        message=("'a at b.org' is not an email address"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Write ``name@domain.org``; letters of ASCII, digits and ``-_%+`` only.

**Source.** REP 149; ``catkin_pkg/package.py``; the schemas.
""",
    ),
    AmentCode(
        "PX074",
        "element-nested",
        "An element is inside one that holds only text",
        XMLLINT,
        Severity.ERROR,
        message=("<url> is inside <license>, which holds text only"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Close the outer element first; only ``<description>`` and ``<export>`` hold others.

**Source.** REP 149; ``catkin_pkg/package.py``; the schemas.
""",
    ),
    AmentCode(
        "PX075",
        "url-malformed",
        "The text of a ``<url>`` is not a URL",
        XMLLINT,
        message=("'http://a.org:port/b' is not a URL"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, and the link leads nowhere.

**Fix.** Correct the URL: a port is a number, ``%`` begins two hexadecimal digits.

**Source.** REP 149, ``<url>``; the schemas, type ``anyURI``.
""",
    ),
)
