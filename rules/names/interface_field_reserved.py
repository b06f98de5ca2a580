"""NM024: fields of interfaces are no keywords of the generated languages."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.generated_code import reserved
from scaffold.model.interface_files import interface_files

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"


class InterfaceFieldReserved(Rule):
    """A field of an interface has the name of a keyword.

    **Why.** It becomes a member in generated code. With a keyword of C or C++ that does not
    compile; with one of Python ``message.from`` is a SyntaxError, and only ``getattr`` reads it.

    **Fix.** Choose another name, such as ``from_frame``.

    **Source.** ``rosidl_generator_py/generate_py_impl.py``, which warns of Python's; the keywords
    of C17 and C++17.
    """

    code = "NM024"
    name = "interface-field-reserved"
    examples = (
        Example("names", {"CMakeLists.txt": _LISTS, "msg/Beat.msg": "string class_name\n"}),
        Example(
            "keywords",
            {"CMakeLists.txt": _LISTS, "msg/Beat.msg": "string class\nint32 from\nbool ok\n"},
            at=("msg/Beat.msg:1", "msg/Beat.msg:2"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for file in interface_files(package):
            for section in file.definition.sections:
                for field in section.fields:
                    message = reserved(field.name)
                    if message:
                        yield self.report(field, message)
