"""Writes scaffold/data/jazzy/interfaces.txt: the common interfaces of ROS 2 Jazzy in compact form.

Usage:

    python -m venv jazzy
    jazzy/bin/pip install ros-jazzy-common-interfaces==5.3.6
    python scripts/bundle_interfaces.py jazzy

where the second python has this checkout installed. The argument is a prefix with
``share/<package>/msg`` and so on: an environment with the wheels of ROS 2, or ``/opt/ros/jazzy``.
All packages of ``PACKAGES`` must be there; those that have no wheel (such as tf2_msgs)
are there when their source directories, of the releases for Jazzy, are linked into ``share``.

Where the content comes from: the definitions of the repositories ros2/common_interfaces,
ros2/rcl_interfaces, ros2/example_interfaces, ros-navigation/navigation2,
ros-controls/ros2_control, ros-perception/vision_msgs (Apache-2.0), ros2/unique_identifier_msgs,
ros2/geometry2, ros-controls/control_msgs, ros-geographic-info/geographic_info,
ros-planning/navigation_msgs and ros-drivers/ackermann_msgs (BSD), in the versions that the output
names. Taken are facts that a program must know to talk to those packages: names, types, bounds,
constants and defaults. Comments, which are their authors' texts, are not taken.
"""

from __future__ import annotations

import os
import sys
import xml.etree.ElementTree as ET

from scaffold import distributions
from scaffold.model.interfaces.definitions import KINDS, Definitions, render
from scaffold.model.interfaces.sources import PrefixSource

PACKAGES = (
    "ackermann_msgs",
    "action_msgs",
    "actionlib_msgs",
    "builtin_interfaces",
    "composition_interfaces",
    "control_msgs",
    "controller_manager_msgs",
    "diagnostic_msgs",
    "example_interfaces",
    "geographic_msgs",
    "geometry_msgs",
    "lifecycle_msgs",
    "map_msgs",
    "nav2_msgs",
    "nav_msgs",
    "rcl_interfaces",
    "rosgraph_msgs",
    "sensor_msgs",
    "service_msgs",
    "shape_msgs",
    "std_msgs",
    "std_srvs",
    "stereo_msgs",
    "tf2_msgs",
    "trajectory_msgs",
    "type_description_interfaces",
    "unique_identifier_msgs",
    "vision_msgs",
    "visualization_msgs",
)
BUNDLE = distributions.JAZZY.path("interfaces.txt")
HEAD = (
    "# Common interfaces of ROS 2 Jazzy: names, types, constants and defaults.\n"
    "# Made by scripts/bundle_interfaces.py from installed packages; do not edit.\n"
)


def main() -> int:
    """Write the bundle."""
    if len(sys.argv) != 2:  # noqa: PLR2004  the program and one argument
        sys.stderr.write("usage: bundle_interfaces.py PREFIX\n")
        return 2
    prefix = sys.argv[1]
    definitions = Definitions([PrefixSource([prefix])])
    text = HEAD + "".join(bundled(definitions, prefix, package) for package in PACKAGES)
    os.makedirs(os.path.dirname(BUNDLE), exist_ok=True)
    with open(BUNDLE, "w", encoding="utf-8") as file:
        file.write(text.rstrip("\n") + "\n")
    sys.stdout.write(f"{os.path.relpath(BUNDLE)}: {len(text.encode())} bytes\n")
    return 0


def bundled(definitions: Definitions, prefix: str, package: str) -> str:
    """Return the part of one package.

    Raises:
        InputError: a definition cannot be read.
    """
    lines = [f"@ {package} {version(prefix, package)}\n"]
    for kind in KINDS:
        for name in definitions.names(package, kind) or ():
            interface = definitions.resolve(f"{package}/{kind}/{name}")
            lines.append(f"= {kind} {name}\n{render(interface)}")
    if len(lines) == 1:
        raise SystemExit(f"{prefix} has no interfaces of {package}")
    return "".join(lines)


def version(prefix: str, package: str) -> str:
    """Return the version of an installed package."""
    manifest = os.path.join(prefix, "share", package, "package.xml")
    text = ET.parse(manifest).findtext("version")  # noqa: S314  an installed file
    if not text:
        raise SystemExit(f"{manifest} has no version")
    return text


if __name__ == "__main__":
    sys.exit(main())
