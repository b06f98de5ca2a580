"""Write scaffold/data/jazzy/names.txt: the names in rclpy on ROS 2 Jazzy.

Run it where the Python packages of Jazzy can be imported. One line for each module, and one for
each class: its full name, a colon, and its names, separated by spaces; methods are
followed by ``()``.
"""

from __future__ import annotations

import ast
import importlib
import inspect
import pkgutil
import textwrap
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

PACKAGES = ("rclpy", "ament_index_python")
TARGET = Path(__file__).parent.parent / "scaffold" / "data" / "jazzy" / "names.txt"


def modules(package: str) -> Iterator[ModuleType]:
    """Yield a package and its public modules."""
    top = importlib.import_module(package)
    yield top
    for info in pkgutil.walk_packages(top.__path__, f"{package}."):
        if not any(part.startswith("_") for part in info.name.split(".")):
            yield importlib.import_module(info.name)


def names_of_module(module: ModuleType) -> set[str]:
    """Return the names that can be imported from a module, including submodules."""
    below = {info.name for info in pkgutil.iter_modules(getattr(module, "__path__", ()))}
    return {name for name in {*vars(module), *below} if not name.startswith("__")}


def names_of_class(class_: type) -> set[str]:
    """Return the attributes of a class and those that its methods set."""
    names = set(dir(class_))
    for base in class_.__mro__:
        names |= set(vars(base))
        if base.__module__.split(".")[0] in PACKAGES:
            tree = ast.parse(textwrap.dedent(inspect.getsource(base)))
            names |= {
                node.attr
                for node in ast.walk(tree)
                if isinstance(node, ast.Attribute)
                and isinstance(node.ctx, ast.Store)
                and isinstance(node.value, ast.Name)
                and node.value.id == "self"
            }
    return {
        f"{name}()" if inspect.isfunction(getattr(class_, name, None)) else name
        for name in names
        if not name.startswith("__")
    }


def lines() -> Iterator[str]:
    """Yield the lines of the file."""
    for package in PACKAGES:
        for module in modules(package):
            yield f"{module.__name__}: {' '.join(sorted(names_of_module(module)))}"
            for name, value in sorted(vars(module).items()):
                is_own = inspect.isclass(value) and value.__module__ == module.__name__
                if is_own and not name.startswith("_"):
                    yield f"{module.__name__}.{name}: {' '.join(sorted(names_of_class(value)))}"


if __name__ == "__main__":
    TARGET.write_text("".join(f"{line}\n" for line in lines()), encoding="utf-8")
