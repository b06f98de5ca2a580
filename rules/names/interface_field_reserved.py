"""NM024: names of interfaces are not keywords or macros of the generated languages."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import interface_files, reserved, reserved_constant, reserved_type

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"


class InterfaceFieldReserved(Rule):
    """A field, a constant or a type of an interface has the name of a keyword or macro.

    **Why.** A field becomes a member in generated code. With a keyword of C or C++ that does not
    compile; with one of Python ``message.from`` is a SyntaxError, and only ``getattr`` reads it.
    A constant ``NULL`` is replaced before the compiler sees it, and no class is called ``None``.

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
            Report(
                "msg/Beat.msg:1:8",
                "'class' is a keyword of C or C++: the generated code does not compile",
            ),
            Report(
                "msg/Beat.msg:2:7", "'from' is a keyword of Python: 'message.from' is a SyntaxError"
            ),
        ),
        Example(
            "macros",
            {"CMakeLists.txt": _LISTS, "msg/Beat.msg": "int8 NULL=0\nint8 EIO=1\nint8 OK=2\n"},
            Report(
                "msg/Beat.msg:1:6",
                "'NULL' is a macro of C: the generated C++ code does not compile",
            ),
            Report(
                "msg/Beat.msg:2:6", "'EIO' is a macro of C: the generated C++ code does not compile"
            ),
        ),
        Example(
            "a type that Python cannot have",
            {"CMakeLists.txt": _LISTS.replace("Beat", "None"), "msg/None.msg": "int8 count\n"},
            Report(
                "msg/None.msg:1:1",
                "'None' is a keyword of Python: the generated module is a SyntaxError",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for file in interface_files(package):
            message = reserved_type(file.name)
            if message:
                yield self.report(package.start_of(file.path), message)
            for section in file.definition.sections:
                for field in section.fields:
                    message = reserved(field.name)
                    if message:
                        yield self.report(field, message)
                for constant in section.constants:
                    message = reserved_constant(constant.name)
                    if message:
                        yield self.report(constant, message)
