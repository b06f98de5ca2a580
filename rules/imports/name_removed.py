"""IM050: code uses names that the distribution has and does not deprecate."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Fix, PythonRule, Report, Severity
from scaffold.api.distributions import of_kind
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import changed_uses

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n{}\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.get_logger().{}('hello')\n"
)
_ELSEWHERE = (
    "from rclpy.node import Node\n\ntry:\n    import serial\n    SERIAL_AVAILABLE = True\n"
    "except ImportError:\n    SERIAL_AVAILABLE = False\n\n\n"
    "class Driver(Node):\n"
    "    def drive(self):\n"
    "        try:\n"
    "            if not SERIAL_AVAILABLE or self.conversion_failed or hasattr(self, 'port'):\n"
    "                self.get_logger().{}('no port')\n"
    "            self.write()\n"
    "            self.read()\n"
    "        except Exception:\n"
    "            self.stop()\n"
)


class NameRemoved(PythonRule):
    """Code uses a name that the distribution has removed or deprecated.

    **Why.** ``AttributeError``, ``ImportError`` or ``ModuleNotFoundError``: Lyrical removed
    deprecated names of rclpy, such as ``get_logger().warn`` and the long names of the policies. Its
    NumPy and Python lack names and arguments, too: ``TypeError`` or ``ValueError``. Deprecated
    names still work, some with a warning.

    **Fix.** Use the replacement. If not all distributions of the package have it, test for it
    first.

    **Source.** The pull requests that ``scaffold/data/changes.toml`` lists.
    """

    code = "IM050"
    name = "name-removed"
    effect = Effect.STOPS_PROGRAM
    is_fixed_for_all = True
    is_deprecation = True
    other_severities = {Severity.INFO: "the distribution still has it, but a later one does not"}
    examples = (
        Example("the old name where it exists", {"talker.py": _NODE.format("", "warn")}),
        Example("the new name", {"talker.py": _NODE.format("", "warning")}, distro="lyrical"),
        Example(
            "a fallback for when the new name fails",
            {
                "talker.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
                "    def talk(self):\n        try:\n"
                "            self.get_logger().warning('hello')\n"
                "        except AttributeError:\n"
                "            self.get_logger().warn('hello')\n"
            },
            distro="lyrical",
        ),
        Example(
            "tested for",
            {
                "talker.py": "try:\n    from rclpy.qos_event import QoSEventHandler\n"
                "except ImportError:\n    from rclpy.event_handler import EventHandler\n"
            },
            distro="lyrical",
        ),
        Example(
            "the old name as the alternative to another import, whatever the handler catches",
            {
                f"{name}.py": "try:\n    from rclpy.event_handler import EventHandler\n"
                f"except{caught}:\n    from rclpy.qos_event import QoSEventHandler\n"
                for name, caught in (("any", ""), ("exceptions", " Exception"))
            },
            distro="lyrical",
        ),
        Example(
            "the old name where something else than an import failed",
            {
                "talker.py": "try:\n    print(open('events.txt').read())\n"
                "except Exception:\n    import rclpy.qos_event\n"
            },
            Report(
                "4:12",
                "rclpy.qos_event was removed in Lyrical: ModuleNotFoundError; use "
                "event_handler (rclpy 1456)",
                fix="Replace with event_handler",
            ),
            fixed={
                "talker.py": "try:\n    print(open('events.txt').read())\n"
                "except Exception:\n    import rclpy.event_handler\n"
            },
            distro="lyrical",
        ),
        Example(
            "the old name",
            {"talker.py": _NODE.format("", "warn")},
            Report(
                "8:9",
                "rclpy.impl.rcutils_logger.RcutilsLogger.warn was removed in Lyrical: "
                "AttributeError; use warning (rclpy 1456)",
                fix="Replace with warning",
            ),
            fixed={"talker.py": _NODE.format("", "warning")},
            distro="lyrical",
        ),
        Example(
            "tested for on the logger",
            {
                "talker.py": _NODE.format("", "warn").replace(
                    "        self.get",
                    "        if hasattr(self.get_logger(), 'warn'):\n            self.get",
                )
            },
            distro="lyrical",
        ),
        Example(
            "a method that returns if the name is missing",
            {
                "talker.py": _NODE.format("", "warn").replace(
                    "        self.get",
                    "        if not hasattr(self.get_logger(), 'warn'):\n            return\n"
                    "        self.get",
                ),
                "listener.py": _NODE.format("", "warn").replace(
                    "        self.get",
                    "        has_new = hasattr(self.get_logger(), 'warning')\n"
                    "        if has_new:\n            self.get_logger().warning('hello')\n"
                    "            return\n        self.get",
                ),
            },
            distro="lyrical",
        ),
        Example(
            "a method that returns if another name is missing",
            {
                "talker.py": _NODE.format("", "warn").replace(
                    "        self.get",
                    "        if not hasattr(self, 'port'):\n            return\n        self.get",
                )
            },
            Report(
                "10:9",
                "rclpy.impl.rcutils_logger.RcutilsLogger.warn was removed in Lyrical: "
                "AttributeError; use warning (rclpy 1456)",
                fix="Replace with warning",
            ),
            fixed={
                "talker.py": _NODE.format("", "warning").replace(
                    "        self.get",
                    "        if not hasattr(self, 'port'):\n            return\n        self.get",
                )
            },
            distro="lyrical",
        ),
        Example(
            "in unrelated conditions and a handler",
            {"talker.py": _ELSEWHERE.format("warn")},
            Report(
                "14:17",
                "rclpy.impl.rcutils_logger.RcutilsLogger.warn was removed in Lyrical: "
                "AttributeError; use warning (rclpy 1456)",
                fix="Replace with warning",
            ),
            fixed={"talker.py": _ELSEWHERE.format("warning")},
            distro="lyrical",
        ),
        Example(
            "names that NumPy 2 removed",
            {
                "area.py": "import numpy as np\nfrom numpy import mat\n\n"
                "values = np.round_(mat('1 2'))\n"
            },
            Report(
                "2:19",
                "numpy.mat was removed in Lyrical: ImportError; use asmatrix (NumPy 2.0)",
                fix="Replace with asmatrix",
            ),
            Report(
                "4:10",
                "numpy.round_ was removed in Lyrical: AttributeError; use round (NumPy 2.0)",
                fix="Replace with round",
            ),
            fixed={
                "area.py": "import numpy as np\nfrom numpy import asmatrix as mat\n\n"
                "values = np.round(mat('1 2'))\n"
            },
            distro="lyrical",
        ),
        Example(
            "with and without a fallback for any error",
            {
                "area.py": "import numpy as np\n\n\ndef area(values, widths):\n    try:\n"
                "        return np.product(values)\n    except Exception:\n"
                "        return sum(values)\n",
                "other.py": "import numpy as np\n\n\ndef area(values, widths):\n    try:\n"
                "        return np.msort(values)\n    except Exception:\n"
                "        return None\n",
            },
            "other.py:6:16: numpy.msort was removed in Lyrical: AttributeError; use "
            "numpy.sort(values, axis=0) (NumPy 2.0)",
            distro="lyrical",
        ),
        Example(
            "names that NumPy 2 removed without a replacement",
            {"area.py": "import numpy as np\n\nleast = np.NINF\n"},
            "3:9: numpy.NINF was removed in Lyrical: AttributeError; use -numpy.inf (NumPy 2.0)",
            distro="lyrical",
        ),
        Example(
            "methods of arrays, and methods of the same name",
            {
                "area.py": "import numpy as np\n\nvalues = np.array([1, 2])\n"
                "width = values.ptp()\nvalues.itemset(0, 3)\n"
                "other = np.zeros(3, '<f4').newbyteorder()\n"
                "kind = np.dtype('<f4').newbyteorder()\n\n\n"
                "def area(shape):\n    return shape.ptp()\n"
            },
            "4:9: numpy.ndarray.ptp was removed in Lyrical: AttributeError; use numpy.ptp(values) "
            "(NumPy 2.0)",
            "5:1: numpy.ndarray.itemset was removed in Lyrical: AttributeError; assign to "
            "values[index] (NumPy 2.0)",
            "6:9: numpy.ndarray.newbyteorder was removed in Lyrical: AttributeError; use "
            "values.view(values.dtype.newbyteorder(order)) (NumPy 2.0)",
            distro="lyrical",
        ),
        Example(
            "arrays in attributes, from parameters and from methods",
            {
                "area.py": "import numpy as np\n\n\ndef area(values: np.ndarray, shape):\n"
                "    first = np.zeros(3).astype(np.uint8).reshape(1, 3)\n"
                "    return values.tostring(), first.tostring(), shape.tostring()\n"
            },
            Report(
                "6:12",
                "numpy.ndarray.tostring was removed in Lyrical: AttributeError; use "
                "tobytes (NumPy 2.3)",
                fix="Replace with tobytes",
            ),
            Report(
                "6:31",
                "numpy.ndarray.tostring was removed in Lyrical: AttributeError; use "
                "tobytes (NumPy 2.3)",
                fix="Replace with tobytes",
            ),
            fixed={
                "area.py": "import numpy as np\n\n\ndef area(values: np.ndarray, shape):\n"
                "    first = np.zeros(3).astype(np.uint8).reshape(1, 3)\n"
                "    return values.tobytes(), first.tobytes(), shape.tostring()\n"
            },
            distro="lyrical",
        ),
        Example(
            "types given as strings, and other strings",
            {
                "area.py": "import numpy as np\nfrom pandas import Series\n\n"
                "a = np.zeros(3, 'float_')\nb = np.full(3, 1, dtype=\"int0\")\n"
                "c = a.astype('bool8')\nd = np.dtype('f8'), np.dtype('str_'), np.array(['int0'])\n"
                "e = Series([1], dtype='int0').astype('int0')\n"
            },
            Report(
                "4:17",
                "numpy.dtype('float_') was removed in Lyrical: TypeError; use float64 (NumPy 2.0)",
                fix="Replace with float64",
            ),
            Report(
                "5:25",
                "numpy.dtype('int0') was removed in Lyrical: TypeError; use intp (NumPy 2.0)",
                fix="Replace with intp",
            ),
            Report(
                "6:14",
                "numpy.dtype('bool8') was removed in Lyrical: TypeError; use bool_ (NumPy 2.0)",
                fix="Replace with bool_",
            ),
            fixed={
                "area.py": "import numpy as np\nfrom pandas import Series\n\n"
                "a = np.zeros(3, 'float64')\nb = np.full(3, 1, dtype=\"intp\")\n"
                "c = a.astype('bool_')\nd = np.dtype('f8'), np.dtype('str_'), np.array(['int0'])\n"
                "e = Series([1], dtype='int0').astype('int0')\n"
            },
            distro="lyrical",
        ),
        Example(
            "internal and public names of NumPy 2",
            {
                "area.py": "import numpy as np\nfrom numpy.lib.arraysetops import unique\n"
                "from numpy.lib.stride_tricks import as_strided\n\n"
                "total = np.lib.function_base.trapz(unique([1]))\n"
                "values = np.lib.pad(as_strided([1]), 1)\n"
            },
            "2:6: numpy.lib.arraysetops was removed in Lyrical: ModuleNotFoundError; it was "
            "internal: use the names of numpy itself (NumPy 2.0)",
            "5:9: numpy.lib.function_base was removed in Lyrical: AttributeError; it was "
            "internal: use the names of numpy itself (NumPy 2.0)",
            "6:10: numpy.lib.pad was removed in Lyrical: AttributeError; use the same name from "
            "numpy (NumPy 2.0)",
            distro="lyrical",
        ),
        Example(
            "removed arguments, and one that is required",
            {
                "area.py": "from argparse import ArgumentParser, BooleanOptionalAction\n"
                "from email.utils import localtime\n\nfrom numpy import fromstring\n\n\n"
                "def area(data):\n    parser = ArgumentParser()\n"
                "    parser.add_argument('--a', action=BooleanOptionalAction, type=bool)\n"
                "    localtime(isdst=1)\n    return fromstring(data, dtype='uint8')\n",
                "other.py": "from argparse import ArgumentParser, BooleanOptionalAction\n"
                "from email.utils import localtime\n\nfrom numpy import fromstring\n\n\n"
                "def area(data, *some, **more):\n    parser = ArgumentParser()\n"
                "    parser.add_argument('--a', action=BooleanOptionalAction, help='more')\n"
                "    parser.add_argument('--b', type=bool)\n    localtime(data)\n"
                "    try:\n        return fromstring(data, dtype='uint8')\n"
                "    except ValueError:\n        fromstring(*some, **more)\n"
                "    return fromstring(data, float, -1, ' '), fromstring(data, sep=' ')\n",
            },
            "area.py:9:62: argparse.BooleanOptionalAction with type was removed in Lyrical: "
            "TypeError; omit it, as it had no effect (Python 3.14)",
            "area.py:10:15: email.utils.localtime with isdst was removed in Lyrical: TypeError; "
            "omit it, as it had no effect (Python 3.14)",
            "area.py:11:12: numpy.fromstring without sep was removed in Lyrical: ValueError; use "
            "numpy.frombuffer for bytes, whose array is read-only, and sep for text (NumPy 2.3)",
            distro="lyrical",
        ),
        Example(
            "names that only later releases of NumPy remove",
            {"area.py": "import numpy as np\n\nfound = np.in1d([1], np.array([1, 2]))\n"},
            Report(
                "3:9",
                "numpy.in1d is deprecated since Lyrical; use numpy.isin, whose result "
                "has the shape of its first argument (NumPy 2.0)",
                severity=Severity.INFO,
            ),
            distro="lyrical",
        ),
        Example(
            "a function of another distribution",
            {"params.py": "from ros2param.api import get_parameter_value\n"},
            "1:27: ros2param.api.get_parameter_value was removed in Jazzy: ImportError; import it "
            "from rclpy.parameter (ros2cli 866)",
        ),
        Example(
            "a long name of a policy",
            {
                "talker.py": "from rclpy.qos import QoSReliabilityPolicy\n\n"
                "policy = QoSReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT\n"
            },
            Report(
                "3:10",
                "rclpy.qos.QoSReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT "
                "was removed in Lyrical: AttributeError; use BEST_EFFORT (rclpy 1456)",
                fix="Replace with BEST_EFFORT",
            ),
            fixed={
                "talker.py": "from rclpy.qos import QoSReliabilityPolicy\n\n"
                "policy = QoSReliabilityPolicy.BEST_EFFORT\n"
            },
            distro="lyrical",
        ),
        Example(
            "modules",
            {
                "talker.py": "from rclpy.qos_event import SubscriptionEventCallbacks\n"
                "from rclpy.topic_endpoint_info import TopicEndpointInfo\n"
            },
            Report(
                "1:6",
                "rclpy.qos_event was removed in Lyrical: ModuleNotFoundError; use "
                "event_handler (rclpy 1456)",
                fix="Replace with event_handler",
            ),
            Report(
                "2:6",
                "rclpy.topic_endpoint_info was removed in Lyrical: "
                "ModuleNotFoundError; use endpoint_info (rclpy 1371)",
                fix="Replace with endpoint_info",
            ),
            fixed={
                "talker.py": "from rclpy.event_handler import SubscriptionEventCallbacks\n"
                "from rclpy.endpoint_info import TopicEndpointInfo\n"
            },
            distro="lyrical",
        ),
        Example(
            "the old name while it is deprecated",
            {"talker.py": _NODE.format("", "warn")},
            Report(
                "8:9",
                "rclpy.impl.rcutils_logger.RcutilsLogger.warn is deprecated since "
                "Kilted, and Lyrical removes it; use warning (rclpy 1456)",
                fix="Replace with warning",
                severity=Severity.INFO,
            ),
            fixed={"talker.py": _NODE.format("", "warning")},
            distro="kilted",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        changes = [item for item in of_kind("name") if item.is_removed or item.is_deprecated]
        for use in changed_uses(module, changes):
            change, is_gone = use.change, use.change.is_removed
            error = f": {use.error}" if is_gone else ""
            advice = f"{change.instead(use.replacement)} ({change.source})"
            message = f"{use.shown} {change.state}{error}; {advice}"
            fix = Fix(f"Replace with {use.replacement}", use.edits) if use.edits else None
            severity = Severity.ERROR if is_gone else Severity.INFO
            yield self.report(use.location, message, fix, severity=severity)
