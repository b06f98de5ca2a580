"""IM045: modules are not called."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule
from scaffold.api.python import PythonModule

_MODULES = {
    "copy": "copy.copy",
    "datetime": "datetime.datetime",
    "glob": "glob.glob",
    "pprint": "pprint.pprint",
    "random": "random.random",
    "time": "time.time",
}


class ModuleCalled(PythonRule):
    """A module is called instead of its function of the same name.

    **Why.** ``TypeError: 'module' object is not callable``; in setup.py the build stops.

    **Fix.** ``from glob import glob``, or ``glob.glob(...)``.

    **Source.** Python documentation, "The import statement".
    """

    code = "IM045"
    name = "module-called"
    examples = (
        Example(
            "the function called", {"setup.py": "import glob\n\nFILES = glob.glob('launch/*')\n"}
        ),
        Example(
            "the module called",
            {"setup.py": "import glob\n\nFILES = glob('launch/*')\n"},
            "3:9: 'glob' is a module, not a function: TypeError; use glob.glob()",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        if not any(item in module.imports_by_root for item in _MODULES):
            return
        for name, function in _MODULES.items():
            for call in module.calls_of(name):
                message = f"{name!r} is a module, not a function: TypeError; use {function}()"
                yield self.report(module.location(call.func), message)
