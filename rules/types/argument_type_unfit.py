"""TY005: arguments have the types that functions of ROS take."""

from __future__ import annotations

import ast
import re

from scaffold.api import Diagnostic, Example, Report, TypeRule
from scaffold.api.rclpy import rclpy_file
from scaffold.api.types import (
    MARKED,
    TypeFinding,
    class_in,
    class_itself,
    full_name,
    has_call,
    in_words,
    is_certain_misfit,
    is_function,
    name_of,
    overload_problem,
    parameters,
    with_article,
)

_NODE = (
    "import rclpy\nfrom rclpy.duration import Duration\nfrom rclpy.node import Node\n"
    "from rclpy.callback_groups import ReentrantCallbackGroup\n\n\n"
    "class Ticker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('ticker')\n"
    "        self.timer = self.create_timer({}, self.tick, callback_group={})\n\n"
    "    def tick(self):\n"
    "        self.get_clock().sleep_for({})\n"
)
_TIMES = (
    "from builtin_interfaces.msg import Time as Stamp\nfrom rclpy.clock import Clock\n"
    "from rclpy.time import Time\nfrom std_msgs.msg import Header\n\n\n"
    "def wait(seconds):\n"
    "    Clock().sleep_until(Stamp(sec=seconds))\n"
    "    return Header(stamp=Time(seconds=seconds))\n"
)
_SPEAKER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Speaker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('speaker')\n"
    "        self.talker = self.create_publisher(String, 'talk', 10)\n"
    "        self.greeting = self.declare_parameter('greeting', 'hello').value\n\n"
    "    def say(self, text):\n"
    "        self.talker.publish(text)\n\n"
    "    def show(self, text):\n"
    "        self.talker.publish(text)\n\n"
    "    def greet(self):\n"
    "        self.say({})\n"
    "        self.show({})\n"
)
_UNCHECKED = (".get_parameter_or",)
"""What works with anything as long as the parameter is declared."""
_ONLY_SHOWN = {("DeclareLaunchArgument()", "description")}
"""What `ros2 launch --show-args` prints, whatever it is."""
_CONVERTING = frozenset({"rclpy.duration.Duration", "rclpy.time.Time"})
"""What calls ``int()`` on its nanoseconds, which are annotated as an int."""
_COMPUTED = r"^(int|float)\*? \| (?:Any|Unknown)$"
"""A number that is computed with a value of unknown type."""
_TIMEOUTS = {"can_transform": 3, "can_transform_full": 5, "transform": 2, "transform_full": 4}
"""Where functions of tf2 with several signatures take a timeout."""
_RIGHT = ("0.1", "ReentrantCallbackGroup()", "Duration(seconds=1.0)")


class ArgumentTypeUnfit(TypeRule):
    """An argument of a function of ROS has a type that the function cannot use.

    **Why.** The function raises ``TypeError`` or ``AttributeError``, at this line or when it uses
    the value.

    **Fix.** Pass an object of the type that the parameter has in ROS 2 Jazzy.

    **Source.** The annotations of the packages of ROS 2 Jazzy.
    """

    code = "TY005"
    name = "argument-type-unfit"
    kinds = frozenset({"invalid-argument-type", "no-matching-overload"})
    examples = (
        Example("the types that it takes", {"ticker.py": _NODE.format(*_RIGHT)}),
        Example(
            "a description in several parts",
            {
                "demo.launch.py": "from launch.actions import DeclareLaunchArgument\n\n"
                "MODE = DeclareLaunchArgument('mode', description=('fast,', 'or slow'))\n"
            },
        ),
        Example(
            "a goal handle of one of two action servers",
            {
                "mover.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n"
                "from tf2_msgs.action import LookupTransform\n\n\n"
                "class Mover(Node):\n    def __init__(self):\n        super().__init__('mover')\n"
                "        self.goal = None\n"
                "        ActionServer(self, LookupTransform, 'look', self.run,\n"
                "                     handle_accepted_callback=self.on_look)\n"
                "        ActionServer(self, Fibonacci, 'count', self.run,\n"
                "                     handle_accepted_callback=self.on_count)\n\n"
                "    def on_look(self, goal):\n        self.goal = goal\n\n"
                "    def on_count(self, goal):\n        self.goal = goal\n"
                "        self.goal.publish_feedback(Fibonacci.Feedback())\n\n"
                "    def run(self, goal):\n        goal.succeed()\n        return goal.request\n"
            },
        ),
        Example(
            "what a method is called with",
            {"speaker.py": _SPEAKER.format("String(data='hello')", "'hello'")},
            Report(
                "15:29",
                "'msg' of publish() must be a std_msgs.msg.String or bytes, not a "
                "str: publish() fails ('text' comes from line 19)",
            ),
        ),
        Example(
            "what other methods are called with: messages, or what is not known",
            {"speaker.py": _SPEAKER.format("String(data='hello')", "self.greeting")},
        ),
        Example(
            "a method that checks the type of its argument",
            {
                "speaker.py": _SPEAKER.format("'hello'", "'hello'").replace(
                    "        self.talker.publish(text)\n",
                    "        if isinstance(text, str):\n            text = String(data=text)\n"
                    "        self.talker.publish(text)\n",
                )
            },
        ),
        Example(
            "the header of a message for the stamp in it",
            {
                "age.py": "from rclpy.node import Node\nfrom rclpy.time import Time\n"
                "from sensor_msgs.msg import Imu\n\n\n"
                "class Age(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('age')\n"
                "        self.create_subscription(Imu, 'imu', self.on_imu, 10)\n\n"
                "    @staticmethod\n"
                "    def seconds(now, stamp):\n"
                "        return (now - Time.from_msg(stamp)).nanoseconds * 1e-9\n\n"
                "    def on_imu(self, imu: Imu) -> None:\n"
                "        self.age = self.seconds(self.get_clock().now(), imu.header)\n"
            },
            Report(
                "13:37",
                "'msg' of from_msg() must be a builtin_interfaces.msg.Time, not a "
                "std_msgs.msg.Header: from_msg() fails ('stamp' comes from line 16)",
            ),
        ),
        Example(
            "a number and a result for the feedback",
            {
                "mover.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n\n\n"
                "class Mover(Node):\n    def __init__(self):\n        super().__init__('mover')\n"
                "        ActionServer(self, Fibonacci, 'count', self.run)\n\n"
                "    def run(self, goal):\n        left = 1.0\n"
                "        step = min(0.5, self.get_parameter('step').value)\n"
                "        while not goal.is_cancel_requested:\n"
                "            left -= step * 0.1\n"
                "            goal.publish_feedback(left)\n"
                "        goal.publish_feedback(Fibonacci.Feedback())\n"
                "        goal.publish_feedback(Fibonacci.Result())\n"
                "        goal.succeed()\n        return Fibonacci.Result()\n"
            },
            Report(
                "16:35",
                "'feedback' of publish_feedback() must be an "
                "example_interfaces.action.Fibonacci_Feedback, not a float: "
                "publish_feedback() fails",
            ),
            Report(
                "18:31",
                "'feedback' of publish_feedback() must be an "
                "example_interfaces.action.Fibonacci_Feedback, not an "
                "example_interfaces.action.Fibonacci_Result: publish_feedback() "
                "fails",
            ),
        ),
        Example(
            "what a declared parameter does not need",
            {
                "port.py": "from rclpy.node import Node\n\n"
                "node = Node('port')\nnode.declare_parameter('port', 1)\n"
                "print(node.get_parameter_or('port', 2))\n"
            },
        ),
        Example(
            "elements of a list of messages",
            {
                "way.py": "from geometry_msgs.msg import Pose, PoseStamped\n"
                "from nav_msgs.msg import Path\n\n\n"
                "class Way:\n"
                "    def __init__(self):\n"
                "        self.poses = [PoseStamped()]\n\n"
                "    def path(self):\n"
                "        self.poses.append(Pose())\n"
                "        path = Path()\n"
                "        path.poses.append(PoseStamped())\n"
                "        path.poses.append(Pose())\n"
                "        return path\n"
            },
            Report(
                "13:27",
                "elements of 'poses' must be a geometry_msgs.msg.PoseStamped, not a "
                "geometry_msgs.msg.Pose: it cannot be published",
            ),
        ),
        Example(
            "a name for a class, an object for a function",
            {
                "read.py": "from launch_ros.actions import LifecycleNode\n"
                "from launch_ros.events.lifecycle import ChangeState\n"
                "from rclpy.serialization import deserialize_message\n"
                "from std_msgs.msg import String\n\n\n"
                "def read(data, kinds, reader):\n"
                "    node = LifecycleNode(\n"
                "        name='a', namespace='', package='demo', executable='a')\n"
                "    ChangeState(lifecycle_node_matcher=lambda action: True, transition_id=1)\n"
                "    ChangeState(lifecycle_node_matcher=node, transition_id=1)\n"
                "    deserialize_message(data, kinds['a'])\n"
                "    deserialize_message(data, String)\n"
                "    while reader.has_next():\n"
                "        deserialize_message(data, 'std_msgs/msg/String')\n"
            },
            Report(
                "11:17",
                "'lifecycle_node_matcher' of ChangeState() must be a function, not "
                "a launch_ros.actions.lifecycle_node.LifecycleNode: ChangeState() "
                "fails",
            ),
            Report(
                "15:35",
                "'message_type' of deserialize_message() must be a class, not a "
                "str: deserialize_message() fails",
            ),
        ),
        Example(
            "the messages that a synchronizer brings",
            {
                "pair.py": "from cv_bridge import CvBridge\n"
                "from message_filters import Subscriber, TimeSynchronizer\n"
                "from rclpy.node import Node\n"
                "from sensor_msgs.msg import CompressedImage, Image\n\n\n"
                "class Pair(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('pair')\n"
                "        self.bridge = CvBridge()\n"
                "        self.left = Subscriber(self, Image, 'left')\n"
                "        self.right = Subscriber(self, CompressedImage, 'right')\n"
                "        self.pairs = TimeSynchronizer([self.left, self.right], 10)\n"
                "        self.pairs.registerCallback(self.on_pair)\n\n"
                "    def on_pair(self, left, right):\n"
                "        self.bridge.imgmsg_to_cv2(left)\n"
                "        self.bridge.imgmsg_to_cv2(right)\n"
            },
            Report(
                "18:35",
                "'img_msg' of imgmsg_to_cv2() must be a sensor_msgs.msg.Image, not "
                "a sensor_msgs.msg.CompressedImage: imgmsg_to_cv2() fails",
            ),
        ),
        Example(
            "a callback with annotations of its own",
            {
                "speaker.py": "from rcl_interfaces.msg import Parameter, SetParametersResult\n"
                "from rclpy.node import Node\n\n\n"
                "class Speaker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('speaker')\n"
                "        self.add_on_set_parameters_callback(self.on_set)\n\n"
                "    def on_set(self, parameters: list[Parameter]) -> SetParametersResult:\n"
                "        return SetParametersResult(successful=bool(parameters))\n"
            },
        ),
        Example(
            "a float, which is made an int",
            {
                "period.py": "import rclpy.time\nfrom rclpy.duration import Duration\n\n\n"
                "PERIOD = Duration(seconds=0, nanoseconds=1e9 / 30)\n"
                "TIMEOUT = rclpy.time.Duration(nanoseconds=3e6)\n"
            },
        ),
        Example(
            "values that are unpacked, each for a field of its own",
            {
                "read.py": "from sensor_msgs.msg import JoyFeedback\n\n"
                "FIELDS = {'type': int, 'id': int, 'intensity': float}\n\n\n"
                "def read(line):\n"
                "    return JoyFeedback(**{key: kind(line[key]) for key, kind in FIELDS.items()})\n"
            },
        ),
        Example(
            "clients of two services in a dictionary",
            {
                "reset.py": "from rclpy.node import Node\n"
                "from std_srvs.srv import SetBool, Trigger\n\n\n"
                "class Resetter(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('resetter')\n"
                "        made = []\n"
                "        made.append(self.create_client(Trigger, 'reset'))\n"
                "        self.asked = {'reset': made[-1]}\n"
                "        made.append(self.create_client(SetBool, 'enable'))\n"
                "        self.asked['enable'] = made[-1]\n\n"
                "    def reset(self):\n"
                "        self.asked['reset'].call_async(Trigger.Request())\n"
            },
        ),
        Example(
            "a str for a number, a class for an object, a number for a duration",
            {"ticker.py": _NODE.format("'0.1'", "ReentrantCallbackGroup", "1.0")},
            Report(
                "10:40",
                "'timer_period_sec' of create_timer() must be a float, not a str: "
                "create_timer() fails",
            ),
            Report(
                "10:58",
                "'callback_group' of create_timer() must be a "
                "rclpy.callback_groups.CallbackGroup or None, not the class "
                "'ReentrantCallbackGroup': create_timer() fails; write "
                "ReentrantCallbackGroup()",
            ),
            Report(
                "13:36",
                "'rel_time' of sleep_for() must be a rclpy.duration.Duration, not a "
                "float: sleep_for() fails; write Duration(seconds=...)",
            ),
        ),
        Example(
            "a number as the timeout of a transformation",
            {
                "look.py": "import tf2_geometry_msgs\nfrom geometry_msgs.msg import PointStamped\n"
                "from tf2_ros import Buffer\n\n\n"
                "def look(buffer: Buffer):\n"
                "    buffer = Buffer()\n"
                "    return buffer.transform(PointStamped(), 'map', timeout=0.5)\n"
            },
            Report(
                "8:60",
                "'timeout' of transform() must be a rclpy.duration.Duration, not a "
                "float: transform() fails; write Duration(seconds=...)",
            ),
        ),
        Example(
            "times of two kinds",
            {"age.py": _TIMES},
            Report(
                "8:25",
                "'until' of sleep_until() must be a rclpy.time.Time, not a "
                "builtin_interfaces.msg.Time: sleep_until() fails; write "
                "rclpy.time.Time.from_msg(...)",
            ),
            Report(
                "9:19",
                "'stamp' of std_msgs.msg.Header is a builtin_interfaces.msg.Time, "
                "not a rclpy.time.Time: it cannot be published; write .to_msg()",
            ),
        ),
        Example(
            "a publisher whose type depends on where the node runs",
            {
                "shooter.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Empty, Float32\n"
                "\n\nclass Shooter(Node):\n"
                "    def __init__(self, in_simulation):\n"
                "        super().__init__('shooter')\n"
                "        self.in_simulation = in_simulation\n"
                "        if in_simulation:\n"
                "            self.publisher = self.create_publisher(Empty, 'shoot', 10)\n"
                "        else:\n"
                "            self.publisher = self.create_publisher(Float32, 'shoot', 10)\n\n"
                "    def shoot(self):\n"
                "        if self.in_simulation:\n"
                "            self.publisher.publish(Empty())\n"
                "        else:\n"
                "            self.publisher.publish(Float32(data=1.0))\n"
            },
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        is_overloaded = finding.kind == "no-matching-overload"
        return self._judge_overload(finding) if is_overloaded else self._judge_argument(finding)

    def _judge_argument(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(
            rf"Argument to (?:[a-z]+ )*`(?P<callee>{MARKED}(?:\.\w+)?)`"
            r" is incorrect: Expected `(?P<expected>.+)`, found `(?P<given>.+)`"
        )
        if matched is None:
            return self._judge_element(finding)
        expected, given = matched["expected"], matched["given"]
        if matched["callee"].endswith(".publish_feedback"):
            given = re.sub(_COMPUTED, r"\1", given)
        is_misfit = is_certain_misfit(expected, given) or _is_uncallable(finding, expected, given)
        if not is_misfit or matched["callee"].endswith(_UNCHECKED) or _is_unpacked(finding):
            return None
        is_for_others = _has_too_many(finding, matched["callee"])  # which TY004 reports
        is_for_others = is_for_others or _is_one_of_publishers(finding)
        if is_for_others or (expected.startswith("(") and is_function(given)):
            return None  # functions differ in their annotations; ND003 counts the arguments
        owner, _, method = matched["callee"].rpartition(".")
        called = owner if method in {"__init__", "__new__"} else method
        where = f"{full_name(called).rpartition('.')[2]}()"
        hint = _instead(expected, given)
        if re.search(r"\.(?:msg|srv|action)\.\w+$", full_name(owner or called)):
            field = _parameter(finding, matched["callee"])
            return self.report(
                finding,
                f"{field!r} of {full_name(owner)} is {with_article(name_of(expected))}, not "
                f"{in_words(given)}: it cannot be published{hint}",
            )
        parameter = _parameter(finding, matched["callee"])
        if expected.startswith("("):
            expected = "function"
        elif expected.startswith("type["):
            expected = "class"
        is_made_int = full_name(called) in _CONVERTING and parameter == "nanoseconds"
        is_made_int = is_made_int and given.rstrip("*") == "float"
        if is_made_int or (where, parameter) in _ONLY_SHOWN:
            return None
        needs = f"{parameter!r} of {where}" if parameter else f"an argument of {where}"
        return self.report(
            finding,
            f"{needs} must be {with_article(name_of(expected))}, not {in_words(given)}: "
            f"{where} fails{hint}",
        )

    def _judge_element(self, finding: TypeFinding) -> Diagnostic | None:
        """Judge what is appended to a list of messages, which nothing checks before it is sent."""
        matched = finding.match(
            r"Argument to bound method `list\.(?:append|insert)` is incorrect: "
            rf"Expected `(?P<expected>{MARKED})`, found `(?P<given>.+)`"
        )
        call = next(
            (node for node in finding.parents() if isinstance(node, ast.Call)),
            None,
        )
        if matched is None or not is_certain_misfit(matched["expected"], matched["given"]):
            return None
        match call:
            case ast.Call(func=ast.Attribute(value=ast.Attribute(attr=field, value=holder))) if (
                not isinstance(holder, ast.Name) or holder.id != "self"
            ):
                return self.report(
                    finding,
                    f"elements of {field!r} must be {with_article(full_name(matched['expected']))},"
                    f" not {in_words(matched['given'])}: it cannot be published",
                )
        return None

    def _judge_overload(self, finding: TypeFinding) -> Diagnostic | None:
        """Judge a timeout: the type checker does not say which argument fits no signature."""
        call = finding.node(ast.Call)
        matched = finding.match(rf"No overload of .*`{MARKED}\.(?P<name>\w+)` matches arguments")
        if call is None or matched is None or matched["name"] not in _TIMEOUTS:
            return None
        value = _timeout(call, matched["name"])
        if not (isinstance(value, ast.Constant) and type(value.value) in {int, float}):
            return None
        name, kind = matched["name"], with_article(type(value.value).__name__)
        return self.report(
            finding.module.location(value),
            f"'timeout' of {name}() must be a rclpy.duration.Duration, not {kind}: {name}() fails; "
            "write Duration(seconds=...)",
        )


def _has_too_many(finding: TypeFinding, callee: str) -> bool:
    """Tell whether the call has more arguments without names than its function takes."""
    call = next((node for node in finding.parents() if isinstance(node, ast.Call)), None)
    return call is not None and overload_problem(finding.package, callee, call).startswith("takes")


def _is_one_of_publishers(finding: TypeFinding) -> bool:
    """Tell whether the object called may be made for another type, as a condition says."""
    call = next((node for node in finding.parents() if isinstance(node, ast.Call)), None)
    if call is None or not isinstance(call.func, ast.Attribute):
        return False
    receiver = call.func.value
    if not isinstance(receiver, ast.Attribute):
        return False
    file = rclpy_file(finding.package, finding.path)
    values = file.evaluator.attribute_values(receiver) or ()
    made = [value for value in values if isinstance(value, ast.Call) and value.args]
    return len({ast.dump(value.args[0]) for value in made}) > 1


def _is_uncallable(finding: TypeFinding, expected: str, given: str) -> bool:
    """Tell whether an object of ROS that cannot be called is given for a function."""
    class_ = class_in(given)
    return expected.startswith("(") and bool(class_) and not has_call(finding.package, class_)


def _timeout(call: ast.Call, name: str) -> ast.expr | None:
    """Return the timeout that one of these functions gets."""
    for keyword in call.keywords:
        if keyword.arg == "timeout":
            return keyword.value
    place = _TIMEOUTS[name]
    return call.args[place] if len(call.args) > place else None


def _instead(expected: str, given: str) -> str:
    """Return what to write instead, where that is clear."""
    wanted, class_ = class_in(expected.partition(" | ")[0]), class_itself(given)
    if wanted and class_:
        return f"; write {full_name(class_).rpartition('.')[2]}()"
    name = full_name(wanted) if wanted else ""
    is_number = re.match(r"(?:int|float)\b|Literal\[-?[0-9]", given) is not None
    if name == "rclpy.duration.Duration" and is_number:
        return "; write Duration(seconds=...)"
    if name == "rclpy.time.Time" and class_in(given).startswith("Time"):
        return "; write rclpy.time.Time.from_msg(...)"
    if name == "builtin_interfaces.msg.Time" and class_in(given).startswith("Time"):
        return "; write .to_msg()"
    return ""


def _is_unpacked(finding: TypeFinding) -> bool:
    """Tell whether the argument is ``**values``: each of them may fit a parameter of its own."""
    return any(
        keyword.arg is None
        and finding.location in {finding.module.location(item) for item in (keyword, keyword.value)}
        for call in finding.module.walk(ast.Call)
        for keyword in call.keywords
    )


def _parameter(finding: TypeFinding, callee: str) -> str:
    """Return the name of the parameter that the place is an argument of."""
    for call in finding.module.walk(ast.Call):
        if not call.lineno <= finding.location.line <= (call.end_lineno or call.lineno):
            continue
        for keyword in call.keywords:
            places = (keyword, keyword.value)
            if any(finding.module.location(item) == finding.location for item in places):
                return keyword.arg or ""
        for number, argument in enumerate(call.args):
            if isinstance(argument, ast.Starred):
                break
            if finding.module.location(argument) == finding.location:
                names = parameters(finding.package, callee)
                return names[number] if number < len(names) else ""
    return ""
