"""Small ROS 2 packages for the tests of ``smoke``: good ones, and one for each kind of failure."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from textwrap import dedent, indent

MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.1.0</version>
  <description>A package of the tests.</description>
  <maintainer email="test@example.org">Test</maintainer>
  <license>Apache-2.0</license>
  {buildtool}
  <exec_depend>rclpy</exec_depend>
  <exec_depend>std_msgs</exec_depend>
  <export>
    <build_type>{build_type}</build_type>
  </export>
</package>
"""

SETUP = """\
from setuptools import setup

setup(
    name='{name}',
    version='0.1.0',
    packages=['{name}'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/{name}']),
        ('share/{name}', ['package.xml']),
    ],
    install_requires=['setuptools'],
    entry_points={{
        'console_scripts': [
{scripts}
        ],
    }},
)
"""

SETUP_CFG = """\
[develop]
script_dir=$base/lib/{name}
[install]
install_scripts=$base/lib/{name}
"""

CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
find_package(rclpy REQUIRED)
ament_python_install_package(${{PROJECT_NAME}})
install(
  PROGRAMS
{scripts}
  DESTINATION lib/${{PROJECT_NAME}}
)
ament_package()
"""

TALKER = '''\
#!/usr/bin/env python3
"""Publish a counter."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
{imports}
from std_msgs.msg import String


class Talker(Node):
    """Publishes a counter."""

    def __init__(self):
        """Create the publisher and the timer."""
        super().__init__('{node}')
        self.publisher = self.create_publisher(String, '{topic}', 10)
        self.timer = self.create_timer({period}, self.on_timer)
        self.count = 0
{begin}

    def on_timer(self):
        """Publish the next number."""
{tick}
        self.publisher.publish(String(data=f'number {{self.count}}'))
        self.count += 1


def main(args=None):
    """Run the node until it is interrupted."""
    try:
        rclpy.init(args=args)
        node = Talker()
{wait}
    except {handled}:
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
'''


def talker(
    topic: str,
    *,
    node: str = "talker",
    imports: str = "",
    period: str = "0.1",
    begin: str = "",
    tick: str = "",
    wait: str = "rclpy.spin(node)",
    handled: str = "(KeyboardInterrupt, ExternalShutdownException)",
) -> str:
    """Return the source of a node that publishes at 10 Hz, with the given replacements."""
    holes = {"begin": begin, "tick": tick, "wait": wait}
    filled = {name: indent(dedent(code), " " * 8) for name, code in holes.items()}
    return TALKER.format(
        topic=topic, node=node, imports=imports, period=period, handled=handled, **filled
    )


IGNORES_SIGINT = talker(
    "/ignores",
    imports="import signal",
    begin="""\
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    """,
)

CRASHES = '''\
"""Crash before there is a node."""

import rclpy


def read_configuration():
    """Fail."""
    raise RuntimeError('no configuration found')


def main():
    """Run into the failure."""
    rclpy.init()
    read_configuration()
'''

CRASHES_LATER = talker(
    "/crashes_later",
    tick="""\
    if self.count == 8:
        raise ValueError('the counter is worn out')
    """,
)

HANGS = '''\
"""Never get to rclpy.init."""

import threading

import rclpy


def main():
    """Wait for what does not come."""
    print('waiting for the device', flush=True)
    threading.Event().wait()
    rclpy.init()
'''

ONCE = '''\
"""A tool, not a node."""


def main():
    """Print and end."""
    print('done')
'''

LISTENER = '''\
"""Hear, and tell on demand."""

import rclpy
from rcl_interfaces.srv import ListParameters
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Float32MultiArray, String


class Listener(Node):
    """Relays what it hears; keeps one message for those who come late."""

    def __init__(self):
        """Create all."""
        super().__init__('listener', namespace='deep')
        self.relay = self.create_publisher(String, 'relayed', 10)
        self.heard = self.create_subscription(String, '/heard', self.relay.publish, 10)
        kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.kept = self.create_publisher(Float32MultiArray, '~/kept', kept)
        self.kept.publish(Float32MultiArray(data=[0.1] * 40))
        self.answers = self.create_service(ListParameters, 'answers', self.on_request)
        self.asks = self.create_client(ListParameters, 'asks')

    def on_request(self, request, response):
        """Answer a request."""
        return response


def main(args=None):
    """Run the node until it is interrupted."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Listener())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
'''

PARENT = talker(
    "/parent",
    imports="import subprocess\nimport sys",
    begin="""\
    code = 'import time; time.sleep(600)'
    subprocess.Popen([sys.executable, '-c', code], start_new_session=True)
    """,
)

GOOD = {
    "talker": talker("/numbers"),
    "listener": LISTENER,
    "once": ONCE,
}

LATE_ONCE = talker(
    "/late_once",
    imports="import os\nimport time",
    begin="""\
    self.is_late = not os.path.exists('../has_run')
    open('../has_run', 'a').close()
    """,
    tick="time.sleep(0.45 * self.is_late)",
)

BAD = {
    "crashes": CRASHES,
    "crashes_later": CRASHES_LATER,
    "hangs": HANGS,
    "ignores": IGNORES_SIGINT,
    "late_once": LATE_ONCE,
    "leaves": talker("/leaves", period="0.5", tick="raise SystemExit"),
    "parent": PARENT,
    "silent": talker("/silent", tick="return"),
    "slow": talker("/slow", imports="import time", tick="time.sleep(0.45)"),
    "traceback": talker("/traceback", handled="ExternalShutdownException"),
    "unspun": talker("/unspun", wait="node.destroy_node()"),
}


def write(root: Path, files: Mapping[str, str]) -> Path:
    """Write files below a directory; return it."""
    for path, text in files.items():
        file = root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    return root


def python_package(root: Path, name: str, modules: Mapping[str, str]) -> Path:
    """Write an ament_python package with one executable for each module."""
    scripts = "\n".join(f"            '{item} = {name}.{item}:main'," for item in modules)
    return write(
        root / name,
        {
            "package.xml": MANIFEST.format(name=name, build_type="ament_python", buildtool=""),
            "setup.py": SETUP.format(name=name, scripts=scripts),
            "setup.cfg": SETUP_CFG.format(name=name),
            f"resource/{name}": "",
            f"{name}/__init__.py": "",
            **{f"{name}/{module}.py": text for module, text in modules.items()},
        },
    )


def cmake_package(root: Path, name: str, modules: Mapping[str, str]) -> Path:
    """Write an ament_cmake package with one executable for each module."""
    scripts = "\n".join(f"    {name}/{item}.py" for item in modules)
    buildtool = "<buildtool_depend>ament_cmake_python</buildtool_depend>"
    return write(
        root / name,
        {
            "package.xml": MANIFEST.format(
                name=name, build_type="ament_cmake", buildtool=buildtool
            ),
            "CMakeLists.txt": CMAKE.format(name=name, scripts=scripts),
            f"{name}/__init__.py": "",
            **{f"{name}/{module}.py": text for module, text in modules.items()},
        },
    )
