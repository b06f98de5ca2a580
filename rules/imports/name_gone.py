"""IM046: the names of other Python packages exist in the releases of Ubuntu 24.04."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Effect, Example, Package, PythonRule, Report, Severity
from scaffold.api.distributions import target
from scaffold.api.python import PythonModule, is_handled

_NODE = "import numpy as np\n\n\ndef area(values):\n    return {}\n"
_GONE: Mapping[str, tuple[str, str]] = {
    "numpy.float": ("since NumPy 1.24", "float or np.float64"),
    "numpy.int": ("since NumPy 1.24", "int or np.int64"),
    "numpy.bool": ("since NumPy 1.24", "bool or np.bool_"),
    "numpy.object": ("since NumPy 1.24", "object"),
    "numpy.str": ("since NumPy 1.24", "str"),
    "numpy.complex": ("since NumPy 1.24", "complex"),
    "numpy.long": ("since NumPy 1.24", "int"),
    "numpy.unicode": ("since NumPy 1.24", "str"),
    "numpy.typeDict": ("since NumPy 1.24", "np.sctypeDict"),
    "numpy.asscalar": ("since NumPy 1.23", "the method .item()"),
    "numpy.alen": ("since NumPy 1.23", "len()"),
    "numpy.rank": ("since NumPy 1.18", "np.ndim()"),
    "PIL.Image.ANTIALIAS": ("since Pillow 10", "Image.LANCZOS"),
    "PIL.Image.LINEAR": ("since Pillow 10", "Image.BILINEAR"),
    "PIL.Image.CUBIC": ("since Pillow 10", "Image.BICUBIC"),
    "scipy.misc.imread": ("since SciPy 1.2", "imageio.imread()"),
    "scipy.misc.imresize": ("since SciPy 1.3", "PIL.Image.resize()"),
    "scipy.interp": ("since SciPy 1.4", "np.interp()"),
    "cv2.cv": ("since OpenCV 3", "the names of cv2 itself"),
    "cv2.SIFT": ("since OpenCV 3", "cv2.SIFT_create()"),
}
"""Removed names with the version and the replacement."""
_BACK = frozenset({"numpy.bool", "numpy.long"})
"""Names that NumPy 2 has again, as other types."""
_LATER: Mapping[str, str] = {
    **dict.fromkeys(("trapezoid",), "np.trapz()"),
    **{f"a{name}": f"np.arc{name}()" for name in ("cos", "sin", "tan", "cosh", "sinh", "tanh")},
    "atan2": "np.arctan2()",
    "concat": "np.concatenate()",
    "permute_dims": "np.transpose()",
    "pow": "np.power()",
    "astype": "the method .astype()",
    "matrix_transpose": "np.swapaxes()",
    "vecdot": "np.einsum()",
    "cumulative_sum": "np.cumsum()",
    "unstack": "tuple(...)",
    "bitwise_count": "bin().count()",
    "unique_values": "np.unique()",
    "isdtype": "np.issubdtype()",
    "bitwise_left_shift": "np.left_shift()",
}
"""Names added in NumPy 2.0; Ubuntu 24.04 (Jazzy) has 1.26."""
_CATCHES = re.compile(r"\b(?:AttributeError|Exception|BaseException)\b")
"""Matches what a handler catches that is for versions without a name."""
_SECOND = (2,)


class NameGone(PythonRule):
    """Code uses a name that NumPy, Pillow, SciPy or OpenCV on Ubuntu 24.04 does not have.

    **Why.** ``AttributeError: module 'numpy' has no attribute 'float'`` when the line is executed.
    Names of NumPy 2 only work on machines with a newer NumPy from pip.

    **Fix.** Use the replacement in the message.

    **Source.** Release notes of NumPy 1.24 and 2.0, Pillow 10 and SciPy; Ubuntu 24.04 has NumPy
    1.26, Pillow 10.2 and SciPy 1.11.
    """

    code = "IM046"
    name = "name-gone"
    effect = Effect.STOPS_PROGRAM
    other_severities = {Severity.WARNING: "the name is one of NumPy 2, and NumPy comes from pip"}
    examples = (
        Example("a name that exists", {"area.py": _NODE.format("np.trapz(values)")}),
        Example(
            "tested first, or set by the code",
            {
                "area.py": _NODE.format("np.trapezoid(values)").replace(
                    "    return",
                    "    if not hasattr(np, 'trapezoid'):\n        np.trapezoid = np.trapz\n"
                    "    return",
                ),
                "b.py": "import numpy as np\n\ntry:\n    real = np.float\n"
                "except AttributeError:\n    real = float\n",
                "c.py": "import cv2\n\ntry:\n    width = cv2.CAP_PROP_FRAME_WIDTH\n"
                "except Exception:\n    width = cv2.cv.CV_CAP_PROP_FRAME_WIDTH\n",
            },
        ),
        Example(
            "a removed name",
            {"area.py": _NODE.format("np.array(values, np.float)")},
            "5:29: numpy.float was removed since NumPy 1.24: AttributeError; use float or "
            "np.float64",
        ),
        Example(
            "removed names of each package",
            {
                "old.py": "import cv2\nimport numpy as np\nimport scipy\nfrom PIL import Image\n"
                "from scipy import misc\n\n\n"
                "def old(values):\n"
                "    yield values.astype(np.int), values.astype(np.bool)\n"
                "    yield np.asscalar(values), np.alen(values), np.rank(values)\n"
                "    yield Image.ANTIALIAS, Image.LINEAR, Image.CUBIC\n"
                "    yield misc.imread, misc.imresize, scipy.interp\n"
                "    yield cv2.cv.CV_CAP_ANY, cv2.SIFT, np.astype(values, float)\n",
            },
            "9:25: numpy.int was removed since NumPy 1.24: AttributeError; use int or np.int64",
            "9:48: numpy.bool was removed since NumPy 1.24: AttributeError; use bool or np.bool_",
            "10:11: numpy.asscalar was removed since NumPy 1.23: AttributeError; use the method "
            ".item()",
            "10:32: numpy.alen was removed since NumPy 1.23: AttributeError; use len()",
            "10:49: numpy.rank was removed since NumPy 1.18: AttributeError; use np.ndim()",
            "11:11: PIL.Image.ANTIALIAS was removed since Pillow 10: AttributeError; use "
            "Image.LANCZOS",
            "11:28: PIL.Image.LINEAR was removed since Pillow 10: AttributeError; use "
            "Image.BILINEAR",
            "11:42: PIL.Image.CUBIC was removed since Pillow 10: AttributeError; use Image.BICUBIC",
            "12:11: scipy.misc.imread was removed since SciPy 1.2: AttributeError; use "
            "imageio.imread()",
            "12:24: scipy.misc.imresize was removed since SciPy 1.3: AttributeError; use "
            "PIL.Image.resize()",
            "12:39: scipy.interp was removed since SciPy 1.4: AttributeError; use np.interp()",
            "13:11: cv2.cv was removed since OpenCV 3: AttributeError; use the names of cv2 itself",
            "13:30: cv2.SIFT was removed since OpenCV 3: AttributeError; use cv2.SIFT_create()",
            Report(
                "13:40",
                "numpy.astype is new in NumPy 2, but Jazzy has 1.26: AttributeError; "
                "use the method .astype()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a name of NumPy 2",
            {
                "area.py": _NODE.format("np.trapezoid(values)"),
                "package.xml": '<package format="3">\n  <name>area</name>\n'
                "  <exec_depend>python3-numpy</exec_depend>\n</package>\n",
            },
            "area.py:5:12: numpy.trapezoid is new in NumPy 2, but Jazzy has 1.26: AttributeError; "
            "use np.trapz()",
        ),
        Example(
            "a name of NumPy 2, without a package",
            {"area.py": _NODE.format("np.concat(values)")},
            Report(
                "5:12",
                "numpy.concat is new in NumPy 2, but Jazzy has 1.26: AttributeError; "
                "use np.concatenate()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "names that exist in NumPy 2",
            {"a.py": _NODE.format("np.trapezoid(np.asarray(values, np.bool))")},
            distro="lyrical",
        ),
        Example(
            "yaml.load() without a loader",
            {
                "a.py": "import yaml\n\n\ndef read(path):\n    with open(path) as file:\n"
                "        return yaml.load(file)\n"
            },
            "6:16: yaml.load() needs a Loader since PyYAML 6: TypeError; use safe_load()",
        ),
        Example(
            "yaml.load() with a loader",
            {
                "a.py": "import yaml\n\n\ndef read(path):\n    with open(path) as file:\n"
                "        return yaml.load(file, Loader=yaml.SafeLoader)\n"
            },
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        if not module.imports_by_root.keys() & {"numpy", "PIL", "scipy", "cv2", "yaml"}:
            return
        for node in module.walk(ast.Attribute):
            name = (module.qualified_name(node) if node.attr in _ATTRIBUTES else None) or ""
            if name not in _GONE and not name.startswith("numpy."):
                continue
            short = name.removeprefix("numpy.")
            is_gone = name in _GONE and _is_gone(name)
            if not (is_gone or (short in _LATER and _numpy() < _SECOND)):
                continue
            if is_handled(module, node, "AttributeError") or _is_replaced(module, node):
                continue
            if is_gone:
                since, instead = _GONE[name]
                message = f"{name} was removed {since}: AttributeError; use {instead}"
                yield self.report(module.location(node), message)
            else:
                has = target().fact("numpy").rpartition(".")[0]
                message = (
                    f"{name} is new in NumPy 2, but {target().title} has {has}: AttributeError; "
                    f"use {_LATER[short]}"
                )
                severity = None if _has_numpy_of_system(package) else Severity.WARNING
                yield self.report(module.location(node), message, severity=severity)
        for call in module.calls_of("yaml.load", "yaml.load_all"):
            loads = len(call.args) == 1 and not call.keywords
            if loads and not is_handled(module, call, "TypeError"):
                message = "yaml.load() needs a Loader since PyYAML 6: TypeError; use safe_load()"
                yield self.report(module.location(call), message)


_ATTRIBUTES = frozenset(name.rpartition(".")[2] for name in (*_GONE, *_LATER))
"""The last parts of the names, for a quick search."""


def _numpy() -> tuple[int, ...]:
    return tuple(map(int, target().fact("numpy").split(".")))


def _is_gone(name: str) -> bool:
    """Return whether the release of the target lacks a name."""
    if name in _BACK and _numpy() >= _SECOND:
        return False
    word, number = _GONE[name][0].removeprefix("since ").split()
    return word != "NumPy" or _numpy() >= tuple(map(int, number.split(".")))


def _is_for_older(module: PythonModule, parent: ast.AST) -> bool:
    """Return whether a block only runs where the new name does not exist either."""
    if not isinstance(parent, ast.ExceptHandler):
        return False
    return parent.type is None or bool(_CATCHES.search(module.text(parent.type)))


def _is_replaced(module: PythonModule, node: ast.Attribute) -> bool:
    """Return whether the module checks for a name, defines it, or uses it as a fallback."""
    if any(_is_for_older(module, parent) for parent in module.parents(node)):
        return True
    stores = [other for other in module.walk(ast.Attribute) if other.attr == node.attr]
    if any(isinstance(other.ctx, ast.Store) for other in stores):
        return True
    return any(
        isinstance(call.func, ast.Name)
        and call.func.id in {"hasattr", "getattr"}
        and any(isinstance(item, ast.Constant) and item.value == node.attr for item in call.args)
        for call in module.walk(ast.Call)
    )


def _has_numpy_of_system(package: Package) -> bool:
    """Return whether a package declares the NumPy of the system."""
    return package.has("package.xml") and "python3-numpy" in package.manifest.declared_names
