"""PX020: imported packages are declared."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity
from scaffold.api.catalog import (
    ROS_PACKAGES,
    is_released,
    is_rosdep_key,
    transitive_dependencies,
)
from scaffold.api.distributions import removed_package, target
from scaffold.api.manifest import (
    declared,
    declaring,
    is_fetched,
    is_in_requirements,
    is_installed_to_build,
    required_packages,
    requirements,
)
from scaffold.api.python import rospack_lookups
from scaffold.api.setup_py import lacks_pytest
from scaffold.api.tests import test_modules

from ._debian import key_of_debian
from ._embedded_pythons import is_for_embedded_python
from ._meant_packages import package_of_key

_LAUNCH = frozenset({"launch", "launch_ros"})
"""Packages installed wherever launch files can be started."""
_MANIFEST = '<package format="3">\n  <name>talker</name>\n{}</package>\n'
_OF_ROS1 = '<buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>'
_INDEX = frozenset({"torch", "torchvision"})
"""Packages often installed with pip, for a specific graphics card."""

_MANIFEST = '<package format="3">\n  <name>talker</name>\n{}</package>\n'


def _manifest(*lines: str) -> str:
    """Return the package.xml of an example; a name stands for an ``<exec_depend>``."""
    elements = (
        line if line.startswith("<") else f"<exec_depend>{line}</exec_depend>" for line in lines
    )
    text = "".join(f"  {element}\n" for element in elements)
    return _MANIFEST.format(text)


class ImportUndeclared(Rule):
    """Python code imports a package that package.xml does not declare.

    **Why.** It works on the author's machine, but on a clean one, rosdep does not install the
    package, and the node fails with ``ModuleNotFoundError``.

    **Fix.** Add an ``<exec_depend>``, or a ``<test_depend>`` if only tests import it. If the
    condition of an existing dependency excludes the distribution, change the condition. Each module
    is reported at its first import, where ``# noqa: PX020`` suppresses it.

    **Source.** REP 149, ``<exec_depend>``: "packages providing ... Python modules".
    """

    code = "PX020"
    name = "import-undeclared"
    effect = Effect.STOPS_START
    other_severities = {
        Severity.WARNING: "only scripts in the share directory import it, or it may be installed "
        "anyway: with `ros2 launch` for launch files, with pip (torch, or listed in "
        "requirements.txt or pyproject.toml), with colcon or rosdep, to build the workspace, as a "
        "package of it, with ros_base, or by an unknown dependency; or it is for the Python of "
        "another program, such as Isaac Sim; or `colcon test` does not run the test, because "
        "setup.py does not declare pytest or CMakeLists.txt names no test",
    }
    examples = (
        Example(
            "tkinter, which matplotlib recommends",
            {
                "package.xml": _manifest("python3-matplotlib"),
                "talker/__init__.py": "",
                "talker/window.py": "import tkinter\n",
            },
        ),
        Example(
            "tkinter, which Debian has separately from Python",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/window.py": "import tkinter\n",
            },
            Report(
                "talker/window.py:1:1",
                "imports 'tkinter', which package.xml does not declare; add "
                "<exec_depend>python3-tk</exec_depend>",
                fix="Declare python3-tk",
            ),
            fixed={"package.xml": _manifest("python3-tk", "rclpy")},
        ),
        Example(
            "declared; the standard library, own modules and guarded imports",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import math\n\nimport rclpy\nfrom talker.text import hello\n"
                "try:\n    import numpy\nexcept ImportError:\n    numpy = None\n"
                "if False:\n    import scipy\n",
                "talker/text.py": "",
            },
        ),
        Example(
            "declared with keys that rosdep cannot resolve, which PX028 reports",
            {
                "package.xml": _manifest("python3-open3d", "python3-py-trees"),
                "talker/__init__.py": "",
                "talker/cloud.py": "import open3d\nimport py_trees\n",
            },
        ),
        Example(
            "a library besides the interfaces",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import robotarm.action\nimport robotarm.gripper\n",
            },
        ),
        Example(
            "development scripts and contents of images, which are not installed",
            {
                "package.xml": _manifest("rclpy"),
                "setup.py": "setup(entry_points={'console_scripts': ['a = talker.a:main']})\n",
                "talker/__init__.py": "",
                "talker/a.py": "import rclpy\n",
                "scripts/draw.py": "import matplotlib\n",
                "test/examples/draw.py": "import matplotlib\n",
                "tools/__init__.py": "",
                "tools/draw.py": "import matplotlib\n",
                "tools/requirements.txt": "matplotlib\n",
                "docker/content/show.launch.py": "import xacro\n",
            },
        ),
        Example(
            "a script in a C++ package; a launch file that is named like a test",
            {
                "package.xml": _manifest(
                    "launch", "<export><build_type>ament_cmake</build_type></export>"
                ),
                "CMakeLists.txt": "project(talker)\nadd_subdirectory(src)\n"
                "install(DIRECTORY launch DESTINATION share/talker)\n",
                "src/CMakeLists.txt": "add_executable(talk talk.cpp)\n",
                "src/plot.py": "import matplotlib\n",
                "launch/test_arm.launch.py": "import launch\nimport xacro\n",
            },
            Report(
                "launch/test_arm.launch.py:2:1",
                "imports 'xacro', which package.xml does not declare; add "
                "<exec_depend>xacro</exec_depend>",
                fix="Declare xacro",
            ),
            fixed={
                "package.xml": _manifest(
                    "launch", "xacro", "<export><build_type>ament_cmake</build_type></export>"
                )
            },
        ),
        Example(
            "a dependency of a declared library",
            {
                "package.xml": _manifest("python3-fastapi", "python3-flask-socketio"),
                "talker/__init__.py": "",
                "talker/page.py": "import fastapi\nimport flask\nimport jinja2\nimport pydantic\n",
            },
        ),
        Example(
            "disabled by a constant; in a branch for ROS 1",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import os\n\nimport rclpy\n\nUSE_GUI = False\n"
                "ros_version = os.environ['ROS_VERSION']\n"
                "if USE_GUI:\n    import PyQt5\n"
                "if ros_version == '1':\n    import numpy\n",
            },
        ),
        Example(
            "an option that a function enables",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\n\nUSE_GUI = False\n\n\ndef start():\n"
                "    global USE_GUI\n    USE_GUI = True\n\n\ndef show():\n"
                "    if USE_GUI:\n        import trimesh\n\n        print(trimesh)\n",
            },
            Report(
                "talker/node.py:13:9",
                "imports 'trimesh', which package.xml does not declare; add "
                "<exec_depend>python3-trimesh-pip</exec_depend>",
                fix="Declare python3-trimesh-pip",
            ),
            fixed={"package.xml": _manifest("python3-trimesh-pip", "rclpy")},
        ),
        Example(
            "declared for the build only",
            {
                "package.xml": _manifest("<build_depend>std_msgs</build_depend>", "rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom std_msgs.msg import String\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'std_msgs', which line 3 of package.xml declares for the "
                "build only: <build_depend> does not install it where the package "
                "runs; add <exec_depend>std_msgs</exec_depend>",
                fix="Declare std_msgs",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _manifest(
                    "<build_depend>std_msgs</build_depend>", "rclpy", "std_msgs"
                )
            },
        ),
        Example(
            "declared for tests only",
            {
                "package.xml": _manifest("rclpy", "<test_depend>std_srvs</test_depend>"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom std_srvs.srv import SetBool\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'std_srvs', which line 4 of package.xml declares for tests "
                "only: <test_depend> does not install it where the package runs; add "
                "<exec_depend>std_srvs</exec_depend>",
                fix="Declare std_srvs",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _manifest("rclpy", "std_srvs", "<test_depend>std_srvs</test_depend>")
            },
        ),
        Example(
            "a library with modules of messages",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom pygazebo.msg import pose_pb2\n",
            },
        ),
        Example(
            "a package with modules in another one",
            {
                "package.xml": _manifest("rclpy", "tf2_ros"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nimport tf2_ros\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'tf2_ros', which line 4 of package.xml declares only as a C++ "
                "library; add <exec_depend>tf2_ros_py</exec_depend>",
                fix="Declare tf2_ros_py",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("rclpy", "tf2_ros", "tf2_ros_py")},
        ),
        Example(
            "libraries with keys named after them, and one without",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import can\nimport dotenv\nimport our_driver\nimport rclpy\n",
                "setup.py": "setup(install_requires=['python-can'])\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'can', which package.xml does not declare; add "
                "<exec_depend>python3-can</exec_depend>",
                fix="Declare python3-can",
            ),
            Report(
                "talker/node.py:2:1",
                "imports 'dotenv', which package.xml does not declare; add "
                "<exec_depend>python3-dotenv</exec_depend>",
                fix="Declare python3-dotenv",
            ),
            fixed={"package.xml": _manifest("python3-can", "python3-dotenv", "rclpy")},
        ),
        Example(
            "a library that dependencies outside of every distribution may bring",
            {
                "package.xml": _manifest("arm_driver", "hand_driver", "rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nimport scipy\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'scipy', which package.xml does not declare; add "
                "<exec_depend>python3-scipy</exec_depend>",
                fix="Declare python3-scipy",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("arm_driver", "hand_driver", "python3-scipy", "rclpy")},
        ),
        Example(
            "a library and messages that one dependency outside of every distribution may bring",
            {
                "package.xml": _manifest("arm_driver", "rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nimport scipy\nfrom nav_msgs.msg import Path\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'scipy', which package.xml does not declare; add "
                "<exec_depend>python3-scipy</exec_depend>",
                fix="Declare python3-scipy",
            ),
            Report(
                "talker/node.py:3:1",
                "imports 'nav_msgs', which package.xml does not declare; add "
                "<exec_depend>nav_msgs</exec_depend>",
                fix="Declare nav_msgs",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("arm_driver", "nav_msgs", "python3-scipy", "rclpy")},
        ),
        Example(
            "a library that no interface package brings; the client library",
            {
                "package.xml": _manifest("arm_msgs"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nimport scipy\nfrom nav_msgs.msg import Path\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'rclpy', which package.xml does not declare; add "
                "<exec_depend>rclpy</exec_depend>",
                fix="Declare rclpy",
            ),
            Report(
                "talker/node.py:2:1",
                "imports 'scipy', which package.xml does not declare; add "
                "<exec_depend>python3-scipy</exec_depend>",
                fix="Declare python3-scipy",
            ),
            Report(
                "talker/node.py:3:1",
                "imports 'nav_msgs', which package.xml does not declare; add "
                "<exec_depend>nav_msgs</exec_depend>",
                fix="Declare nav_msgs",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("arm_msgs", "nav_msgs", "python3-scipy", "rclpy")},
        ),
        Example(
            "packages of the workspace",
            {
                "package.xml": _manifest(),
                "talker/__init__.py": "",
                "talker/node.py": "import arm\n",
                "test/test_node.py": "import hand\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'arm', which package.xml does not declare: `colcon build "
                "--packages-up-to talker` leaves it out; add "
                "<exec_depend>arm</exec_depend>",
                fix="Declare arm",
                severity=Severity.WARNING,
            ),
            Report(
                "test/test_node.py:1:1",
                "imports 'hand', which package.xml does not declare: `colcon test` "
                "runs the tests without it; add <test_depend>hand</test_depend>",
                fix="Declare hand",
            ),
            fixed={"package.xml": _manifest("arm", "<test_depend>hand</test_depend>")},
            neighbors={
                name: {
                    "package.xml": f"<package><name>{name}</name></package>\n",
                    f"{name}/__init__.py": "",
                }
                for name in ("arm", "hand")
            },
        ),
        Example(
            "a library that a package of the workspace is built with",
            {
                "package.xml": _manifest("arm"),
                "talker/__init__.py": "",
                "talker/node.py": "import numpy\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'numpy', which package.xml does not declare; add "
                "<exec_depend>python3-numpy</exec_depend>",
                fix="Declare python3-numpy",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("arm", "python3-numpy")},
            neighbors={
                "arm": {
                    "package.xml": "<package><name>arm</name>\n"
                    "<build_depend>python3-numpy</build_depend></package>\n"
                }
            },
        ),
        Example(
            "test dependencies of scripts that are not installed, but on the path of tests",
            {
                "package.xml": _manifest("<test_depend>python3-tqdm</test_depend>"),
                "CMakeLists.txt": "project(talker)\nif(BUILD_TESTING)\n"
                "  ament_add_pytest_test(talk test/test_talk.py\n"
                "    APPEND_ENV PYTHONPATH=${CMAKE_SOURCE_DIR}/scripts)\nendif()\n",
                "scripts/bags/__init__.py": "",
                "scripts/bags/read.py": "import tqdm\n",
                "scripts/draw.py": "import matplotlib\n",
                "test/test_talk.py": "import bags.read\n",
            },
        ),
        Example(
            "messages that only tests use",
            {
                "package.xml": _manifest(),
                "CMakeLists.txt": "project(talker)\nset(_NAME ${PROJECT_NAME})\n"
                'set(PROJECT_NAME "talker_test_msgs")\n'
                "rosidl_generate_interfaces(${PROJECT_NAME} test/msg/A.msg SKIP_INSTALL)\n"
                "set(PROJECT_NAME ${_NAME})\n",
                "test/msg/A.msg": "int32 a\n",
                "test/test_a.py": "from talker_test_msgs.msg import A\n",
            },
        ),
        Example(
            "a test dependency, as CMake only uses it for tests",
            {
                "package.xml": _manifest("<test_depend>rclpy</test_depend>"),
                "CMakeLists.txt": "project(talker)\nif(BUILD_TESTING)\n"
                "  add_subdirectory(src/system)\nendif()\n",
                "src/system/talk.py": "import rclpy\n",
                "src/system/test_talk.launch.py": "import rclpy\n",
            },
        ),
        Example(
            "a program that is named like a test",
            {
                "package.xml": _manifest(
                    "rclpy", "<export>\n    <build_type>ament_cmake</build_type>\n  </export>"
                ),
                "CMakeLists.txt": "project(talker)\n"
                "install(PROGRAMS scripts/tf_test.py DESTINATION lib/talker)\n",
                "scripts/tf_test.py": "import rclpy\nimport tf2_ros\n",
            },
            Report(
                "scripts/tf_test.py:2:1",
                "imports 'tf2_ros', which package.xml does not declare; add "
                "<exec_depend>tf2_ros_py</exec_depend>",
                fix="Declare tf2_ros_py",
            ),
            fixed={
                "package.xml": _manifest(
                    "rclpy",
                    "tf2_ros_py",
                    "<export>\n    <build_type>ament_cmake</build_type>\n  </export>",
                )
            },
        ),
        Example(
            "declared under a custom condition",
            {
                "package.xml": _manifest(
                    "rclpy", '<exec_depend condition="$SIMULATION == yes">gazebo_msgs</exec_depend>'
                ),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom gazebo_msgs.msg import ModelState\n",
            },
        ),
        Example(
            "declared for another distribution",
            {
                "package.xml": _manifest(
                    "rclpy", '<exec_depend condition="$ROS_DISTRO == humble">std_msgs</exec_depend>'
                ),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom std_msgs.msg import String\n",
            },
            "talker/node.py:2:1: imports 'std_msgs', and line 4 of package.xml declares it only "
            "if $ROS_DISTRO == humble, which excludes Jazzy; change the condition, or guard the "
            "import",
        ),
        Example(
            "in a package for ROS 1 as well",
            {
                "package.xml": _manifest(_OF_ROS1),
                "talker/__init__.py": "",
                "talker/node.py": "import numpy\nfrom std_msgs.msg import String\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'numpy', which package.xml does not declare; add "
                "<exec_depend>python3-numpy</exec_depend>",
                fix="Declare python3-numpy",
            ),
            Report(
                "talker/node.py:2:1",
                "imports 'std_msgs', which package.xml does not declare; add "
                '<exec_depend condition="$ROS_VERSION == 2">std_msgs</exec_depend>',
                fix="Declare std_msgs",
            ),
            fixed={
                "package.xml": _manifest(
                    _OF_ROS1,
                    "python3-numpy",
                    '<exec_depend condition="$ROS_VERSION == 2">std_msgs</exec_depend>',
                )
            },
        ),
        Example(
            "declared for this distribution and for another one",
            {
                "package.xml": _manifest(
                    '<exec_depend condition="$ROS_DISTRO == humble">rclpy</exec_depend>',
                    '<exec_depend condition="$ROS_DISTRO != humble">rclpy</exec_depend>',
                ),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\n",
            },
        ),
        Example(
            "a launch file, in a package that does not declare launch",
            {
                "package.xml": _manifest("rclpy"),
                "launch/a.launch.py": "from launch import LaunchDescription\n",
            },
            Report(
                "launch/a.launch.py:1:1",
                "imports 'launch', which package.xml does not declare; add "
                "<exec_depend>launch</exec_depend>",
                fix="Declare launch",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("launch", "rclpy")},
        ),
        Example(
            "a library that many install with pip",
            {
                "package.xml": _manifest(),
                "talker/__init__.py": "",
                "talker/node.py": "import torch\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'torch', which package.xml does not declare; add "
                "<exec_depend>python3-torch</exec_depend>",
                fix="Declare python3-torch",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("python3-torch")},
        ),
        Example(
            "messages that an unknown dependency of the same family may bring",
            {
                "package.xml": _manifest("arm_bringup"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom arm_msgs.msg import State\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'rclpy', which package.xml does not declare; add "
                "<exec_depend>rclpy</exec_depend>",
                fix="Declare rclpy",
            ),
            Report(
                "talker/node.py:2:1",
                "imports 'arm_msgs', which package.xml does not declare; add "
                "<exec_depend>arm_msgs</exec_depend>, and the package to the "
                "workspace: Jazzy lacks it",
                fix="Declare arm_msgs",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("arm_bringup", "arm_msgs", "rclpy")},
        ),
        Example(
            "a package that is installed with `ros2 launch`",
            {
                "package.xml": _manifest(),
                "launch/a.launch.py": "import ament_index_python\nimport launch_xml\n",
            },
            Report(
                "launch/a.launch.py:1:1",
                "imports 'ament_index_python', which package.xml does not declare; add "
                "<exec_depend>ament_index_python</exec_depend>",
                fix="Declare ament_index_python",
                severity=Severity.WARNING,
            ),
            Report(
                "launch/a.launch.py:2:1",
                "imports 'launch_xml', which package.xml does not declare; add "
                "<exec_depend>launch_xml</exec_depend>",
                fix="Declare launch_xml",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("ament_index_python", "launch_xml")},
        ),
        Example(
            "old keys for pip",
            {
                "package.xml": _manifest("python-transforms3d-pip", "python-utm-pip"),
                "talker/__init__.py": "",
                "talker/node.py": "import transforms3d\nimport utm\n",
            },
        ),
        Example(
            "a library in requirements.txt",
            {
                "package.xml": _manifest(),
                "requirements.txt": "numpy\ntorch>=2.0\n",
                "talker/__init__.py": "",
                "talker/node.py": "import torch\n",
            },
        ),
        Example(
            "a library in requirements.txt under another name",
            {
                "package.xml": _manifest(),
                "requirements.txt": "# hardware\npyserial>=3.5\n",
                "talker/__init__.py": "",
                "talker/node.py": "import serial\n",
            },
            Report(
                "talker/node.py:1:1",
                "imports 'serial', which package.xml does not declare; add "
                "<exec_depend>python3-serial</exec_depend>",
                fix="Declare python3-serial",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("python3-serial")},
        ),
        Example(
            "declared by the name of its Debian package",
            {
                "package.xml": _manifest("ros-jazzy-std-msgs"),
                "talker/__init__.py": "",
                "talker/node.py": "from std_msgs.msg import String\n",
            },
        ),
        Example(
            "a ROS 1 node, kept next to its ROS 2 version",
            {
                "package.xml": _manifest(),
                "talker/__init__.py": "",
                "talker/old.py": "import rospy\nfrom sensor_msgs.msg import Joy\n",
            },
        ),
        Example(
            "rospkg, which does not find ROS 2 packages",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nimport rospkg\n\n"
                "path = rospkg.RosPack().get_path('talker')\n",
            },
        ),
        Example(
            "a script in a data directory",
            {
                "package.xml": _manifest("<export><build_type>ament_cmake</build_type></export>"),
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "install(DIRECTORY tools DESTINATION share/${PROJECT_NAME})\n"
                "install(PROGRAMS tools/talk.py DESTINATION lib/${PROJECT_NAME})\n"
                "ament_package()\n",
                "tools/draw.py": "import matplotlib\nimport yaml\n",
                "tools/talk.py": "import yaml\n",
            },
            Report(
                "tools/draw.py:1:1",
                "imports 'matplotlib', which package.xml does not declare; add "
                "<exec_depend>python3-matplotlib</exec_depend>",
                fix="Declare python3-matplotlib",
                severity=Severity.WARNING,
            ),
            Report(
                "tools/talk.py:1:1",
                "imports 'yaml', which package.xml does not declare; add "
                "<exec_depend>python3-yaml</exec_depend>",
                fix="Declare python3-yaml",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _manifest(
                    "python3-matplotlib",
                    "python3-yaml",
                    "<export><build_type>ament_cmake</build_type></export>",
                )
            },
        ),
        Example(
            "a library of a server that a script of Isaac Sim starts, and one that a node uses too",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nimport requests\n",
                "talker/server.py": "import fastapi\nimport requests\n",
                "talker/start.py": "from isaacsim import SimulationApp\n\nimport server\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'requests', which package.xml does not declare; add "
                "<exec_depend>python3-requests</exec_depend>",
                fix="Declare python3-requests",
            ),
            Report(
                "talker/server.py:1:1",
                "imports 'fastapi', which package.xml does not declare; add "
                "<exec_depend>python3-fastapi</exec_depend>",
                fix="Declare python3-fastapi",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": _manifest("python3-fastapi", "python3-requests", "rclpy")},
        ),
        Example(
            "a message package and a Python library are missing",
            {
                "package.xml": _manifest("rclpy"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\nfrom std_msgs.msg import String\n",
            },
            Report(
                "talker/node.py:2:1",
                "imports 'std_msgs', which package.xml does not declare; add "
                "<exec_depend>std_msgs</exec_depend>",
                fix="Declare std_msgs",
            ),
            fixed={"package.xml": _manifest("rclpy", "std_msgs")},
        ),
        Example(
            "by a test that finds the sources of another package itself",
            {
                "package.xml": _manifest(),
                "test/test_node.py": "import sys\nfrom pathlib import Path\n\n"
                "sys.path.insert(0, str(Path(__file__).parents[2] / 'hand'))\n\nimport hand\n",
            },
            neighbors={"hand": {"package.xml": _MANIFEST.format("").replace("talker", "hand")}},
        ),
        Example(
            "by a test that CMakeLists.txt registers",
            {
                "package.xml": _manifest("<buildtool_depend>ament_cmake</buildtool_depend>"),
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "find_package(ament_cmake_pytest REQUIRED)\n"
                "ament_add_pytest_test(limits test/test_limits.py)\nament_package()\n",
                "test/test_limits.py": "import requests\n\n\n"
                "def test_limits():\n    assert requests\n",
            },
            Report(
                "test/test_limits.py:1:1",
                "imports 'requests', which package.xml does not declare; add "
                "<test_depend>python3-requests</test_depend>",
                fix="Declare python3-requests",
            ),
            fixed={
                "package.xml": _manifest(
                    "<buildtool_depend>ament_cmake</buildtool_depend>",
                    "<test_depend>python3-requests</test_depend>",
                )
            },
        ),
        Example(
            "by a test that CMakeLists.txt does not name",
            {
                "package.xml": _manifest("<buildtool_depend>ament_cmake</buildtool_depend>"),
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "ament_package()\n",
                "test/test_limits.py": "import requests\n\n\n"
                "def test_limits():\n    assert requests\n",
            },
            Report(
                "test/test_limits.py:1:1",
                "imports 'requests', which package.xml does not declare; add "
                "<test_depend>python3-requests</test_depend>",
                fix="Declare python3-requests",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _manifest(
                    "<buildtool_depend>ament_cmake</buildtool_depend>",
                    "<test_depend>python3-requests</test_depend>",
                )
            },
        ),
        Example(
            "a library that comes with a declared one",
            {
                "package.xml": _manifest("python3-requests"),
                "talker/__init__.py": "",
                "talker/fetch.py": "import requests\nimport urllib3\n",
            },
        ),
        Example(
            "by a test, if setup.py does not declare pytest",
            {
                "package.xml": _manifest("<export><build_type>ament_python</build_type></export>"),
                "setup.py": "from setuptools import setup\n\nsetup(name='talker')\n",
                "test/test_copyright.py": "import ament_copyright\n\n\n"
                "def test_copyright():\n    assert ament_copyright\n",
            },
            Report(
                "test/test_copyright.py:1:1",
                "imports 'ament_copyright', which package.xml does not declare; add "
                "<test_depend>ament_copyright</test_depend>",
                fix="Declare ament_copyright",
                severity=Severity.WARNING,
            ),
            fixed={
                "package.xml": _manifest(
                    "<test_depend>ament_copyright</test_depend>",
                    "<export><build_type>ament_python</build_type></export>",
                )
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        for need in required_packages(package):
            if removed_package(need.module) and package.workspace.get(need.module) is None:
                continue  # reported by package-removed
            dependencies = declared(package, for_tests=need.for_tests)
            if any(key in dependencies.direct or key in dependencies.along for key in need.keys):
                continue
            is_from_pip = is_in_requirements(package, need.module)
            if need.module in _INDEX and (is_from_pip or _is_required(package, need.module)):
                continue
            alike = (
                (key_of_debian(item.name), f"{item.name}-pip", package_of_key(item.name))
                for item in manifest.dependencies
            )
            if not all(map(frozenset(need.keys).isdisjoint, alike)):
                continue  # reported by dependency-malformed or dependency-unresolvable
            if _is_by_rospkg(package, need) or _adds_sources(package, need):
                continue
            comes_otherwise = _comes_with_launch(need) or need.module in _INDEX or need.in_data
            comes_otherwise = comes_otherwise or is_from_pip
            names = (item.name for item in manifest.dependencies)
            comes_otherwise = comes_otherwise or any(_is_library_of(name, need) for name in names)
            is_built = package.workspace.get(need.module) is not None
            comes_otherwise = comes_otherwise or (is_built and not need.for_tests)
            comes_otherwise = comes_otherwise or dependencies.may_use(package, need.keys[0])
            comes_otherwise = comes_otherwise or is_installed_to_build(package, need.keys)
            comes_otherwise = comes_otherwise or is_for_embedded_python(package, need.module)
            is_unrun = need.for_tests and _runs_no_test(package)
            severity = Severity.WARNING if comes_otherwise or is_unrun else Severity.ERROR
            purposes = ("run", "test") if need.for_tests else ("run",)
            other = manifest.left_out(need.keys, *purposes)
            if other is not None:
                message = (
                    f"imports {need.module!r}, and line {other.location.line} of package.xml "
                    f"declares it only if {other.condition}, which excludes "
                    f"{target().title}; change the condition, or guard the import"
                )
                yield self.report(need, message, severity=severity)
                continue
            tag = "test_depend" if need.for_tests else "exec_depend"
            tag = "run_depend" if manifest.format == 1 and tag == "exec_depend" else tag
            needed = declaring(package, tag, need.keys[0])
            message = f"imports {need.module!r}, which {_why_missing(package, need)}"
            if is_built:
                message += (
                    ": `colcon test` runs the tests without it"
                    if need.for_tests
                    else f": `colcon build --packages-up-to {package.name}` leaves it out"
                )
            message += f"; {needed.advice}"
            if _is_unknown(package, need):
                message += f", and the package to the workspace: {target().title} lacks it"
            cause = f"dependency {need.keys[0]}"
            yield self.report(need, message, needed.fix, severity=severity, cause=cause)


def _is_library_of(name: str, need: requirements.Requirement) -> bool:
    """Return whether a package is the C++ library whose Python module has a package of its own.

    ``ros_base`` brings the modules of ``tf2_ros``, and most manifests only declare the library.
    """
    return name == need.module and name in ROS_PACKAGES and name not in need.keys


def _why_missing(package: Package, need: requirements.Requirement) -> str:
    """Return why a package may be missing where the import runs."""
    for dependency in package.manifest.dependencies:
        if dependency.name in need.keys and dependency.kind.startswith(("build", "test")):
            line = dependency.location.line
            purpose = "tests" if dependency.kind == "test_depend" else "the build"
            return (
                f"line {line} of package.xml declares for {purpose} only: <{dependency.kind}> "
                "does not install it where the package runs"
            )
        if _is_library_of(dependency.name, need):
            line = dependency.location.line
            return f"line {line} of package.xml declares only as a C++ library"
    return "package.xml does not declare"


def _is_unknown(package: Package, need: requirements.Requirement) -> bool:
    """Return whether interfaces are those of a package that is neither released nor nearby."""
    module = need.module
    is_known = is_released(module) or module in ROS_PACKAGES or is_rosdep_key(need.keys[0])
    is_near = package.workspace.get(module) is not None or is_fetched(package, module)
    return not (is_known or is_near)


def _comes_with_launch(need: requirements.Requirement) -> bool:
    key = need.keys[0]
    return key in _LAUNCH or (need.for_launch and key in transitive_dependencies({"ros2launch"}))


def _is_by_rospkg(package: Package, need: requirements.Requirement) -> bool:
    """Return whether module-of-ros1-imported reports a need, as rospkg looks packages up."""
    return need.module == "rospkg" and bool(rospack_lookups(package, need.location.path))


def _adds_sources(package: Package, need: requirements.Requirement) -> bool:
    """Return whether a test adds the sources of a package of the workspace to ``sys.path``."""
    if not need.for_tests or package.workspace.get(need.module) is None:
        return False
    text = package.source(need.location.path).text
    named = re.search(rf"[\"'/]{re.escape(need.module)}[\"'/]", text)
    return "sys.path" in text and named is not None


def _runs_no_test(package: Package) -> bool:
    """Return whether colcon runs no Python test.

    It needs pytest in setup.py, or a test file or directory in CMakeLists.txt.
    """
    if package.build_type == "ament_cmake":
        values = (value for command in package.cmake.commands for value in command.values)
        return not any(map(_names_tests, values))
    return lacks_pytest(package) and not any(file.classes for file in test_modules(package))


def _names_tests(value: str) -> bool:
    """Return whether a value is a test file, a pattern of Python files, or a directory of tests."""
    name = value.rstrip("/").rpartition("/")[2]
    return name in {"test", "tests"} or (".py" in name and ("*" in name or "test" in name))


def _is_required(package: Package, module: str) -> bool:
    """Return whether setup.py asks pip for a module."""
    wanted = re.compile(rf"(?:[ \t]*|.*['\"]){module}\b(?!\.)")
    text = package.source("setup.py").text if package.has("setup.py") else ""
    return any(wanted.match(line) for line in text.splitlines())
