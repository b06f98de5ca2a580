"""TY008: ROS objects are only called, indexed and iterated over if they support it."""

from __future__ import annotations

import ast

from scaffold.api import Diagnostic, Example, TypeRule
from scaffold.api.rclpy import is_method
from scaffold.api.types import TypeFinding, class_in, in_words, is_certain, is_function

_DOES = {
    "not-callable": "cannot be called",
    "not-subscriptable": "has no elements",
    "not-iterable": "cannot be looped over",
    "invalid-await": "cannot be awaited",
    "invalid-context-manager": "cannot be used in `with`",
    "invalid-raise": "cannot be raised",
}
_NUMBERS = frozenset({"int", "float", "bool"})
_NODE = (
    "from geometry_msgs.msg import Point\n\n\n"
    "def height():\n"
    "    point = Point(z=0.5)\n"
    "    return {}\n"
)
_ODOMETRY = (
    "class Odometry:\n"
    "    def __init__(self):\n"
    "        self.x = self.y = self.yaw = 0.0\n\n"
    "    def pose(self):\n"
    "        return self.x, self.y, self.yaw\n"
)
_DRIVE = (
    "from rclpy.node import Node\n\nfrom .odometry import Odometry\n\n\n"
    "class Drive(Node):\n"
    "    def tick(self):\n"
    "        self.odometry = Odometry()\n"
    "        {} = self.odometry.pose()\n"
)
_NUMBER = (
    "from geometry_msgs.msg import Point\nfrom rclpy.node import Node\n"
    "from rclpy.time import Time\nfrom tf2_ros import Buffer\n\n\n"
    "class Ticker(Node):\n"
    "    def tick(self):\n"
    "        self.buffer = Buffer()\n"
    "        now = self.get_clock().now()\n"
    "        start = now.{}\n"
    "        ok, why = self.buffer.can_transform('a', 'b', Time(){})\n"
    "        self.get_logger().info(f'{{start}} {{ok}} {{why}}')\n"
    "        point = Point()\n"
    "        return point{}\n"
)


class ObjectMisused(TypeRule):
    """An object is called, indexed, iterated, awaited or unpacked, but does not support it.

    The object comes from ROS, or a function of the workspace returns it.

    **Why.** ``TypeError: 'Point' object is not subscriptable``, or ``ValueError: too many values to
    unpack``, when the line runs.

    **Fix.** Use the fields or methods of the object: ``point.z`` instead of ``point[2]``. Unpack
    as many values as the function returns.

    **Source.** The classes of ROS 2 Jazzy; the code of the workspace.
    """

    code = "TY008"
    name = "object-misused"
    kinds = frozenset({*_DOES, "invalid-assignment"})
    examples = (
        Example(
            "dictionary with tuples of different lengths, unpacked in a method",
            {
                "boxes.py": "from rclpy.node import Node\n\n\n"
                "class Boxes(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('boxes')\n"
                "        self.boxes = []\n\n"
                "    def add(self, x, y):\n"
                "        self.boxes.append({'center': (x, y), 'bounds': (x, x + 1, y, y + 1)})\n\n"
                "    def widths(self):\n"
                "        return [self.width(box['bounds']) for box in self.boxes]\n\n"
                "    def width(self, bounds):\n"
                "        low, high, _, _ = bounds\n"
                "        return high - low\n"
            },
        ),
        Example(
            "entries of different types in the dictionaries of another method",
            {
                "watch.py": "from rclpy.node import Node\n\n\n"
                "class Watch(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('watch')\n"
                "        self.seen = {}\n\n"
                "    def add(self, name, x, y):\n"
                "        now = self.get_clock().now()\n"
                "        self.seen[name] = {'position': (x, y), 'size': 1, 'time': now}\n\n"
                "    def places(self):\n"
                "        for name, item in self.seen.items():\n"
                "            x, y = item['position']\n"
                "            print(name, x, y)\n"
            },
        ),
        Example(
            "message awaited, client entered and message raised",
            {
                "ask.py": "from rclpy.node import Node\nfrom std_msgs.msg import String\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Ask(Node):\n"
                "    async def ask(self):\n"
                "        client = self.create_client(Trigger, 'start')\n"
                "        response = await client.call(Trigger.Request())\n"
                "        with client as opened:\n"
                "            print(response, opened)\n"
                "        raise String(data='failed')\n"
            },
            "9:26: a std_srvs.srv.Trigger.Response cannot be awaited: TypeError",
            "10:14: an rclpy.client.Client cannot be used in `with`: TypeError",
            "12:15: a std_msgs.msg.String cannot be raised: TypeError",
        ),
        Example(
            "callbacks in a table, with a list in the last column of some rows",
            {
                "servo.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import String, UInt16\n\n\n"
                "class Servo(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('servo')\n"
                "        for topic in [\n"
                "            [self.on_pwm, 'servo{}', UInt16, 1, [1, 2]],\n"
                "            [self.on_mode, 'mode', String, 1],\n"
                "        ]:\n"
                "            if len(topic) > 4:\n"
                "                callback, name, type_, depth, numbers = topic\n"
                "                for number in numbers:\n"
                "                    topic = name.format(number)\n"
                "                    self.create_subscription(type_, topic, callback, depth)\n\n"
                "    def on_pwm(self, msg):\n        print(msg)\n\n"
                "    def on_mode(self, msg):\n        print(msg)\n"
            },
        ),
        Example("access to a field", {"height.py": _NODE.format("point.z")}),
        Example(
            "parameters converted by a function of another package",
            {
                "plan.py": "from plans import nested\nfrom rclpy.node import Node\n\n\n"
                "class Planner(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('planner')\n"
                "        self.plans = self.get_parameters_by_prefix('plans')\n"
                "        self.plans = nested(self.plans)\n\n"
                "    def start(self):\n"
                "        for plan in self.plans.values():\n"
                "            plan['starts'] = plan['start']\n"
                "        for name, plan in self.plans.items():\n"
                "            plan['name'] = plan['start']\n"
            },
        ),
        Example(
            "dictionary with values of different types",
            {
                "latest.py": "from geometry_msgs.msg import Point\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import Float64MultiArray\n\n\n"
                "class Latest(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('latest')\n"
                "        self.latest = {}\n"
                "        self.create_subscription(Point, 'point', self.on_point, 10)\n"
                "        self.create_subscription(Float64MultiArray, 'arm', self.on_arm, 10)\n\n"
                "    def remember(self, name, value):\n"
                "        self.latest[name] = value\n\n"
                "    def on_point(self, msg):\n"
                "        self.remember('point', msg)\n\n"
                "    def on_arm(self, msg):\n"
                "        self.remember('arm', list(msg.data))\n"
                "        shoulder, elbow = self.latest['arm']\n"
                "        print(shoulder, elbow, self.latest['arm'][:1])\n"
            },
        ),
        Example(
            "indexing a Point",
            {"height.py": _NODE.format("point[2]")},
            "6:12: a geometry_msgs.msg.Point has no elements: TypeError",
        ),
        Example(
            "calling a QoS profile and a publisher",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from rclpy.qos import qos_profile_sensor_data\n"
                "from std_msgs.msg import String\n\n\n"
                "class Talker(Node):\n"
                "    def start(self):\n"
                "        self.talker = self.create_publisher(\n"
                "            String, 'talk', qos_profile_sensor_data())\n\n"
                "    def say(self, text):\n"
                "        self.talker(String(data=text))\n"
            },
            "9:29: an rclpy.qos.QoSProfile cannot be called: TypeError",
            "12:9: an rclpy.publisher.Publisher cannot be called: TypeError",
        ),
        Example(
            "correct number of names",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/drive.py": _DRIVE.format("x, y, yaw"),
            },
        ),
        Example(
            "return value that continues on the next line",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY.replace("self.y, ", "self.y, \\\n            "),
                "rover/drive.py": _DRIVE.format("x, y, yaw"),
            },
        ),
        Example(
            "too many names for the returned values",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/odometry.py": _ODOMETRY,
                "rover/drive.py": _DRIVE.format("x, y, yaw, speed"),
            },
            "rover/drive.py:9:9: not enough values for 4 names: ValueError",
        ),
        Example(
            "dictionary with tuples of different lengths, unpacked directly",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/gate.py": "from rclpy.node import Node\n\n\n"
                "class Gate(Node):\n"
                "    def tick(self, areas):\n"
                "        posts = []\n"
                "        for x, y in areas:\n"
                "            posts.append({'center': (x, y), 'box': (x, y, 8, 9)})\n"
                "        post = posts[-1]\n"
                "        x, y, width, height = post['box']\n",
            },
        ),
        Example(
            "tuples of different lengths, unpacked after a check of the first element",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/zones.py": "from rclpy.node import Node\n\n\n"
                "class Zones(Node):\n"
                "    def tick(self):\n"
                "        zones = []\n"
                "        zones.append(('queue', 'a', 3))\n"
                "        zones.append(('pair', 'b', 0.5, True))\n"
                "        for zone in zones:\n"
                "            if zone[0] == 'queue':\n"
                "                _, name, members = zone\n"
                "            else:\n"
                "                _, name, width, is_fresh = zone\n",
            },
        ),
        Example(
            "method of Node that is replaced after the call",
            {
                "talker.py": "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
                "class Talker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('talker')\n"
                "        self.heard = self.create_subscription(String, 'a', print, 10)\n"
                "        self.create_subscription = self.create_publisher(String, 'b', 10)\n"
            },
        ),
        Example(
            "correct use of nanoseconds, can_transform() and the fields of a point",
            {"height.py": _NUMBER.format("nanoseconds", ", return_debug_tuple=True", ".x")},
        ),
        Example(
            "calling an int, unpacking a bool",
            {"height.py": _NUMBER.format("nanoseconds()", "", ".x")},
            "11:17: 'nanoseconds' is an int, not a method: TypeError; remove the parentheses",
            "12:19: a bool cannot be looped over: TypeError",
        ),
        Example(
            "attribute whose type is a union in the Python stubs",
            {
                "serve.py": "from socketserver import TCPServer\n\n"
                "from rclpy.node import Node\n\n\n"
                "def url(address):\n    host, port = address\n"
                "    return f'http://{host}:{port}'\n\n\n"
                "def serve(server: TCPServer):\n"
                "    Node(url(server.server_address))\n\n\n"
                "serve(TCPServer(('', 1), None))\n"
            },
        ),
        Example(
            "loop over len() without range()",
            {
                "names.py": "from sensor_msgs.msg import JointState\n\n\n"
                "def names(state: JointState):\n"
                "    first = [state.name[i] for i in range(len(state.name))]\n"
                "    return first + [state.name[i] for i in len(state.name)]\n"
            },
            "6:44: an int cannot be looped over: TypeError; use range(len(...))",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        unpacked = finding.match(r"(?P<problem>.+) values to unpack: Expected (?P<names>\d+)")
        if unpacked is not None:
            problem = f"{unpacked['problem'].lower()} values for {unpacked['names']} names"
            message = f"{problem}: ValueError"
            is_unclear = _is_asked_for(finding) or _is_of_table(finding)
            return None if is_unclear else self.report(finding, message)
        matched = finding.kind in _DOES and (
            finding.match(
                r"(?:Object of type|Cannot subscript object of type|Cannot raise object of type) "
                r"`(?P<type>[^`]+)`.*"
            )
            or finding.match(r"`(?P<type>[^`]+)` is not awaitable.*")
        )
        if not matched:
            return None
        if finding.kind == "not-callable" and _is_replaced(finding):
            return None  # a call before the replacement calls the method
        type_ = matched["type"]
        if type_ in _NUMBERS:
            return self._judge_number(finding, type_)
        is_known = class_in(type_) and is_certain(type_) and not _is_entry(finding)
        if not is_known and not (is_function(type_) and finding.kind != "not-callable"):
            return None
        message = f"{in_words(type_)} {_DOES[finding.kind]}: TypeError"
        return self.report(finding, message)

    def _judge_number(self, finding: TypeFinding, type_: str) -> Diagnostic | None:
        """Judge the value of an attribute or a method of another object."""
        node = finding.expression()
        match node:
            case ast.Call(func=ast.Attribute(value=owner, attr=name), args=[], keywords=[]) if (
                finding.kind == "not-callable" and not _is_self(owner)
            ):
                message = f"{name!r} is {in_words(type_)}, not a method: TypeError"
                return self.report(finding, f"{message}; remove the parentheses")
            case ast.Call(func=ast.Attribute(value=owner)) | ast.Attribute(value=owner) if (
                finding.kind != "not-callable" and not _is_self(owner)
            ):
                message = f"{in_words(type_)} {_DOES[finding.kind]}: TypeError"
                return self.report(finding, message)
            case ast.Call(func=ast.Name(id="len")) if finding.kind == "not-iterable":
                message = f"{in_words(type_)} {_DOES[finding.kind]}: TypeError"
                return self.report(finding, f"{message}; use range(len(...))")
        return None


def _is_self(node: ast.expr) -> bool:
    return isinstance(node, ast.Name) and node.id == "self"


def _is_asked_for(finding: TypeFinding) -> bool:
    """Return whether an enclosing condition checks the unpacked value, which may vary in type."""
    inner: ast.AST | None = finding.innermost
    name = ""
    for node in finding.parents():
        match node:
            case ast.Assign(value=ast.Name(id=unpacked)):
                name = unpacked
            case ast.If(test=condition) | ast.IfExp(test=condition) | ast.While(test=condition):
                if inner is not condition and _mentions(condition, name):
                    return True
            case ast.Match(subject=subject) if _mentions(subject, name):
                return True
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                return False
        inner = node
    return False


def _is_of_table(finding: TypeFinding) -> bool:
    """Return whether the unpacked value is from a dictionary.

    The type checker does not distinguish its keys, whose values may have other lengths.
    """
    for node in finding.parents():
        if isinstance(node, ast.Assign):
            values = [node.value]
            if isinstance(node.value, ast.Name):
                values += finding.arguments_for(node.value)
            return any(map(_has_key, values))
    return False


def _has_key(node: ast.expr) -> bool:
    return isinstance(node, ast.Subscript) and isinstance(node.slice, ast.Constant | ast.Name)


def _is_entry(finding: TypeFinding) -> bool:
    """Return whether the object is looked up by a text; its type may be that of another key."""
    match finding.expression():
        case ast.Subscript(slice=ast.Constant(value=str())):
            return True
    return False


def _mentions(node: ast.expr, name: str) -> bool:
    return any(isinstance(item, ast.Name) and item.id == name for item in ast.walk(node))


def _is_replaced(finding: TypeFinding) -> bool:
    """Return whether the callee is assigned to the name of a method of Node."""
    func = finding.expression()
    func = func.func if isinstance(func, ast.Call) else func
    return isinstance(func, ast.Attribute) and is_method("rclpy.node.Node", func.attr)
