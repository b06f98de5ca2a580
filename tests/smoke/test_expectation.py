"""Expectations that ``smoke`` derives from sources, and their comparison with observations."""

from __future__ import annotations

from dataclasses import replace
from textwrap import dedent, indent

import pytest

from scaffold.model.package import Package
from scaffold.smoke.declared import expectations
from scaffold.smoke.expectation import Expectation, Offer, Publication, compare
from scaffold.smoke.result import Observation, Topic
from tests.smoke.smoke_packages import LISTENER, MANIFEST, ONCE, SETUP, talker

STRING = "std_msgs/msg/String"


def python(module: str, **more: str) -> Package:
    """Return an ament_python package ``demo`` with the executable ``run``."""
    scripts = "            'run = demo.run:main',"
    return Package.of(
        {
            "package.xml": MANIFEST.format(name="demo", build_type="ament_python", buildtool=""),
            "setup.py": SETUP.format(name="demo", scripts=scripts),
            "demo/__init__.py": "",
            "demo/run.py": module,
            **{f"demo/{name}.py": text for name, text in more.items()},
        }
    )


def node(init: str, methods: str = "", main: str = "rclpy.spin(Talker())") -> Package:
    """Return a package whose node has this in its constructor and these methods."""
    return python(
        "import rclpy\n"
        "from rclpy.callback_groups import ReentrantCallbackGroup\n"
        "from rclpy.node import Node\n"
        "from std_msgs.msg import String\n\n\n"
        "class Talker(Node):\n"
        "    def __init__(self):\n"
        "        super().__init__('talker')\n"
        "        self.pub = self.create_publisher(String, 'words', 10)\n"
        f"{indent(dedent(init), ' ' * 8)}\n\n"
        f"{indent(dedent(methods), ' ' * 4)}\n\n"
        "def main():\n"
        "    rclpy.init()\n"
        f"{indent(dedent(main), ' ' * 4)}\n"
    )


TICK = """\
def tick(self):
    self.pub.publish(String())
"""


@pytest.mark.parametrize(
    ("init", "methods", "rate", "publishes"),
    [
        pytest.param("self.create_timer(0.5, self.tick)", TICK, 2.0, "certain", id="timer"),
        pytest.param(
            "self.declare_parameter('rate', 20.0)\n"
            "rate = self.get_parameter('rate').value\n"
            "self.create_timer(1.0 / rate, self.tick)",
            TICK, 20.0, "certain", id="parameter",
        ),
        pytest.param(
            "self.create_timer(0.5, self.tick)\nself.create_timer(0.25, self.tick)",
            TICK, 6.0, "certain", id="two timers",
        ),
        pytest.param(
            "self.create_timer(0.5, self.outer)",
            TICK + "\ndef outer(self):\n    self.tick()\n    self.tick()\n",
            4.0, "certain", id="twice through another method",
        ),
        pytest.param(
            "self.timer = self.create_timer(0.5, self.tick)",
            TICK + "    self.timer.cancel()\n", None, "perhaps", id="cancelled",
        ),
        pytest.param(
            "self.create_timer(0.5, self.tick)",
            "def tick(self):\n    if self.ready:\n        self.pub.publish(String())\n",
            None, "perhaps", id="condition",
        ),
        pytest.param(
            "self.create_timer(0.5, self.tick)",
            "def tick(self):\n    if not self.ready:\n        return\n"
            "    self.pub.publish(String())\n",
            None, "perhaps", id="early return",
        ),
        pytest.param(
            "self.create_timer(0.5, self.tick)",
            "def tick(self):\n    return\n    self.pub.publish(String())\n",
            None, "never", id="never gets there",
        ),
        pytest.param("", TICK, None, "never", id="no timer"),
        pytest.param("", "", None, "never", id="no publish"),
        pytest.param("self.pub.publish(String())", "", None, "certain", id="once"),
        pytest.param(
            "self.create_subscription(String, 'heard', self.hear, 10)",
            "def hear(self, msg):\n    self.pub.publish(msg)\n",
            None, "perhaps", id="relay",
        ),
        pytest.param(
            "self.create_subscription(String, 'heard', self.pub.publish, 10)",
            "", None, "perhaps", id="relay without a method",
        ),
        pytest.param("helper(self.pub)", "", None, "perhaps", id="handed on"),
        pytest.param(
            "threading.Thread(target=self.tick).start()", TICK, None, "perhaps", id="thread"
        ),
        pytest.param(
            "self.create_timer(0.5, self.tick, callback_group=ReentrantCallbackGroup())",
            TICK, 2.0, "certain", id="callback group",
        ),
        pytest.param(
            "self.create_timer(0.5, self.tick, callback_group=Throttled())",
            TICK, None, "perhaps", id="callback group of their own",
        ),
        pytest.param(
            "self.create_timer(period(), self.tick)", TICK, None, "certain", id="unknown period"
        ),
    ],
)  # fmt: skip
def test_rate_and_certainty_of_publications(
    init: str, methods: str, rate: float | None, publishes: str
) -> None:
    certain, never = publishes == "certain", publishes == "never"
    result = expectations(node(init, methods))["run"]
    (publication,) = result.publications
    assert (publication.topic, publication.type) == ("/words", STRING)
    assert (publication.rate_hz, publication.certain, publication.never) == (rate, certain, never)
    assert (result.is_node, result.source) == (True, "demo/run.py")


@pytest.mark.parametrize(
    ("name", "arguments", "topic"),
    [
        ("words", "", "/words"),
        ("/words", "", "/words"),
        ("~/words", "", "/talker/words"),
        ("words", ", namespace='deep/er'", "/deep/er/words"),
        ("~/words", ", namespace='/deep'", "/deep/talker/words"),
        ("/words", ", namespace='/deep'", "/words"),
    ],
)
def test_full_name_of_topics(name: str, arguments: str, topic: str) -> None:
    source = talker(name).replace("('talker')", f"('talker'{arguments})")
    assert [item.topic for item in expectations(python(source))["run"].publications] == [topic]


@pytest.mark.parametrize("arguments", [", namespace=unknown()", ", cli_args=[]", ", **options"])
def test_unknown_node_name_gives_no_expectation(arguments: str) -> None:
    source = talker("words").replace("('talker')", f"('talker'{arguments})")
    assert expectations(python(source))["run"].publications == ()


@pytest.mark.parametrize(
    "words",
    ["['--ros-args', '-r', '__ns:=/moved']", "'--ros-args -r words:=/others'.split()"],
)
def test_program_with_own_ros_arguments_gives_no_names(words: str) -> None:
    source = talker("words").replace("rclpy.init(args=args)", f"rclpy.init(args={words})")
    result = expectations(python(source))["run"]
    assert (result.publications, result.is_node) == ((), True)


def test_node_class_that_is_not_instantiated_is_ignored() -> None:
    package = node("", main="rclpy.spin(Other())")
    assert expectations(package)["run"].publications == ()


def test_node_of_another_module() -> None:
    main = (
        "import rclpy\nfrom demo.nodes import Talker\n\n\ndef main():\n    rclpy.spin(Talker())\n"
    )
    result = expectations(python(main, nodes=talker("/words")))["run"]
    assert [(item.topic, item.type) for item in result.publications] == [("/words", STRING)]


@pytest.mark.parametrize(
    ("init", "main", "rate", "certain"),
    [
        ("self.tick()\nself.create_timer(0.5, self.tick)", "rclpy.spin(Talker())", 2.0, True),
        ("", "node = Talker()\nnode.pub.publish(String())\nrclpy.spin(node)", None, True),
        ("", "node = Talker()\nrclpy.spin(node)\nnode.pub.publish(String())", None, False),
    ],
    ids=["also at the start", "before spin", "after spin"],
)  # fmt: skip
def test_publications_in_constructor_and_main(
    init: str, main: str, rate: float | None, certain: bool
) -> None:
    item = expectations(node(init, TICK, main))["run"].publications[0]
    assert (item.rate_hz, item.certain, item.never) == (rate, certain, False)


def test_publisher_attribute_initialized_with_none() -> None:
    init = """\
        self.late = None
        self.late = self.create_publisher(String, 'late', 10)
        self.create_timer(0.5, lambda: self.late.publish(String()))
    """
    _, late = expectations(node(dedent(init)))["run"].publications
    assert (late.topic, late.rate_hz) == ("/late", 2.0)


def test_relay_and_latched_message() -> None:
    assert expectations(python(LISTENER))["run"].publications == (
        Publication("/deep/relayed", STRING, None, certain=False),
        Publication("/deep/listener/kept", "std_msgs/msg/Float32MultiArray", None, certain=True),
    )


def test_program_without_rclpy_is_no_node() -> None:
    assert expectations(python(ONCE))["run"].is_node is False


@pytest.mark.parametrize(("guard", "runs_nothing"), [(True, False), (False, True)])
def test_script_that_never_calls_main_runs_nothing(guard: bool, runs_nothing: bool) -> None:
    source = talker("/words")
    script = source if guard else source.partition("\n\nif __name__")[0] + "\n"
    package = Package.of(
        {
            "package.xml": MANIFEST.format(name="demo", build_type="ament_cmake", buildtool=""),
            "CMakeLists.txt": "project(demo)\n"
            "install(PROGRAMS scripts/run.py DESTINATION lib/${PROJECT_NAME} RENAME run)\n",
            "scripts/run.py": script,
        },
        executable=("scripts/run.py",),
    )
    result = expectations(package)["run"]
    assert result.runs_nothing is runs_nothing
    assert len(result.publications) == (1 if guard else 0)


@pytest.mark.parametrize(
    ("lines", "names"),
    [
        ("install(PROGRAMS run.py tool.py DESTINATION lib/demo)", ["run.py", "tool.py"]),
        ("install(PROGRAMS run.py tool.py DESTINATION bin)", ["run.py"]),
        ("if(BUILD_TESTING)\ninstall(PROGRAMS run.py DESTINATION lib/demo)\nendif()", []),
        ("install(FILES run.py DESTINATION lib/demo)", []),
    ],
)
def test_programs_expected_by_ros2_run(lines: str, names: list[str]) -> None:
    package = Package.of(
        {
            "package.xml": MANIFEST.format(name="demo", build_type="ament_cmake", buildtool=""),
            "CMakeLists.txt": f"project(demo)\n{lines}\n",
            "run.py": talker("/words"),
            "tool.py": ONCE,
        }
    )
    assert list(expectations(package)) == names


LEAVES = "def tick(self):\n    raise SystemExit\n    self.pub.publish(String())\n"
LEAVES_IN_TIME = (
    "def tick(self):\n    if self.is_full:\n        raise SystemExit\n"
    "    self.pub.publish(String())\n"
)
SELDOM = "def tick(self):\n    if self.is_full:\n        self.pub.publish(String())\n"
TIMER = "self.create_timer(0.5, self.tick)"


@pytest.mark.parametrize(
    ("init", "methods", "rate"),
    [
        (TIMER, TICK, 2.0),
        (TIMER, LEAVES, 2.0),
        (TIMER, LEAVES_IN_TIME, 2.0),
        (TIMER, SELDOM, None),
        ("", TICK, None),
        ("self.create_subscription(String, 'heard', self.tick, 10)", TICK, None),
    ],
    ids=["always", "leaves at once", "may leave", "condition", "no timer", "relay"],
)
def test_program_that_ends_before_its_timer_fires(
    init: str, methods: str, rate: float | None
) -> None:
    expectation = expectations(node(init, methods))["run"]
    assert expectation.publications[0].timer_hz == rate
    problems, _ = compare(expectation, Observation(), 0.6, finished=True)
    problem = (
        "exited on its own after 0.6 s, before a message on /words: "
        f"demo/run.py publishes {STRING} at 2 Hz"
    )
    assert list(map(str, problems)) == ([problem] if rate else [])
    assert compare(expectation, seen(1, None, 0.0), 0.6, finished=True)[0] == []


# -- comparison


def seen(count: int, rate: float | None, span: float, watched: float | None = None) -> Observation:
    """Return an observation of ``/words``."""
    topic = Topic(
        "/words", STRING, 1, count=count, rate_hz=rate, span=span,
        watched=span if watched is None else watched, types=(STRING,),
    )  # fmt: skip
    return Observation(nodes=("/talker",), topics=(topic,))


def expecting(
    rate: float | None, *, certain: bool = True, kind: str = STRING, sources: int = 1
) -> Expectation:
    publication = Publication("/words", kind, rate, certain=certain, sources=sources)
    return Expectation((publication,), is_node=True, source="talker.py")


@pytest.mark.parametrize(
    ("rate", "observation", "problem"),
    [
        (10.0, seen(50, 10.4, 4.9), None),
        (10.0, seen(50, 9.6, 4.9), None),
        (10.0, seen(50, 10.7, 4.9), "/words is published at 10.7 Hz"),
        (200.0, seen(900, 180.0, 4.9), None),
        (200.0, seen(900, 160.0, 4.9), "/words is published at 160 Hz"),
        (1000.0, seen(5, 1.0, 0.9, 0.9), "only 5 messages on /words in 0.9 s"),
        (10.0, seen(4, 7.0, 0.5, 0.5), None),
        (0.5, seen(3, 0.5, 4.0), None),
        (0.5, seen(2, 0.25, 4.0), "/words is published at 0.25 Hz"),
        (10.0, seen(3, 10.0, 0.2, 5.0), "only 3 messages on /words in 5.0 s"),
        (10.0, seen(1, None, 0.0, 5.0), "only 1 message on /words in 5.0 s"),
        (None, seen(1, None, 0.0, 5.0), None),
    ],
)
def test_observed_rate_is_compared(
    rate: float | None, observation: Observation, problem: str | None
) -> None:
    problems, notes = compare(expecting(rate), observation, 5.5)
    message = f"talker.py publishes {STRING}" + (f" at {rate:g} Hz" if rate else "")
    assert list(map(str, problems)) == ([f"{problem}: {message}"] if problem else [])
    assert notes == []


def test_bursts_of_several_publishers() -> None:
    assert compare(expecting(3.0), seen(9, 3.4, 2.4), 3.0)[0] != []
    assert compare(expecting(3.0, sources=2), seen(9, 3.4, 2.4), 3.0)[0] == []


def test_unused_publisher_is_reported() -> None:
    unused = Expectation((Publication("/words", STRING, None, never=True),), source="talker.py")
    problems, _ = compare(unused, seen(0, None, 0.0), 5.0)
    assert list(map(str, problems)) == ["no message on /words: no running code calls publish()"]
    assert compare(unused, Observation(), 1.0, finished=True) == ([], [])


def test_missing_messages_are_reported() -> None:
    problems, notes = compare(expecting(10.0), seen(0, None, 0.0), 9.0)
    assert list(map(str, problems)) == [
        f"no message on /words within 9.0 s: talker.py publishes {STRING} at 10 Hz"
    ]
    assert notes == []
    assert compare(expecting(None, certain=False), seen(0, None, 0.0), 9.0) == (
        [],
        ["no message on /words: it is only published on some event"],
    )
    assert compare(expecting(0.2), seen(0, None, 0.0), 9.0) == (
        [],
        ["no message on /words yet: its period is 5 s"],
    )


def test_timers_do_not_fire_without_sim_time_clock() -> None:
    parameters = {"/talker": {"use_sim_time": True}, "/other": None}
    silent = replace(seen(0, None, 0.0), parameters=parameters)
    (problem,), _ = compare(expecting(10.0), silent, 9.0)
    assert problem.message.endswith("; /talker has use_sim_time, and nothing publishes /clock")
    clock = Topic("/clock", "rosgraph_msgs/msg/Clock", 1)
    (problem,), _ = compare(expecting(10.0), replace(silent, topics=(*silent.topics, clock)), 9.0)
    assert "clock" not in problem.message


def test_nodes_with_the_same_name() -> None:
    _, (note,) = compare(Expectation(), Observation(nodes=("/one",), doubled=("/one",)), 5.0)
    assert note.startswith("several nodes are named /one: ")


def test_missing_topic_and_wrong_type() -> None:
    problems, _ = compare(expecting(10.0), Observation(nodes=("/talker",)), 5.0)
    assert list(map(str, problems)) == [
        f"nothing publishes /words: talker.py publishes {STRING} at 10 Hz"
    ]
    problems, _ = compare(expecting(10.0, kind="std_msgs/msg/Bool"), seen(50, 10.0, 4.9), 5.0)
    assert list(map(str, problems)) == [
        f"/words has the type {STRING}: talker.py publishes std_msgs/msg/Bool at 10 Hz"
    ]


OFFERS = """\
self.create_service(SetBool, '~/switch', self.answer)
self.server = ActionServer(self, Fibonacci, 'numbers', self.execute)
self.client = self.create_client(SetBool, 'other')
if self.pub:
    self.create_service(SetBool, 'perhaps', self.answer)
"""


def test_missing_services_and_actions_are_reported() -> None:
    package = node(OFFERS, TICK + "def late(self):\n    self.create_service(SetBool, 'late', None)")
    text = package.source("demo/run.py").text.replace(
        "import String\n",
        "import String\nfrom std_srvs.srv import SetBool\nfrom rclpy.action import ActionServer\n"
        "from example_interfaces.action import Fibonacci\n",
    )
    expectation = expectations(python(text))["run"]
    assert expectation.offers == (
        Offer("service", "/talker/switch", "std_srvs/srv/SetBool"),
        Offer("action", "/numbers", "example_interfaces/action/Fibonacci"),
    )
    seen = Observation(nodes=("/talker",), services=(("/talker/switch", "std_srvs/srv/Trigger"),))
    problems, _ = compare(Expectation(offers=expectation.offers, source="run.py"), seen, 5.0)
    assert list(map(str, problems)) == [
        "/talker/switch has the type std_srvs/srv/Trigger: run.py offers std_srvs/srv/SetBool",
        "nothing offers the action /numbers: run.py offers example_interfaces/action/Fibonacci",
    ]
    seen = Observation(
        services=(("/talker/switch", "std_srvs/srv/SetBool"),),
        actions=(("/numbers", "example_interfaces/action/Fibonacci"),),
    )
    expected = Expectation(offers=expectation.offers)
    assert compare(expected, seen, 5.0) == ([], [])
    assert compare(expected, Observation(), 0.5, finished=True) == ([], [])


def test_several_types_and_unreadable_messages() -> None:
    topic = Topic("/words", "a/msg/A", 2, types=("a/msg/A", "b/msg/B"), error="no module 'a'")
    problems, _ = compare(Expectation(), Observation(topics=(topic,)), 5.0)
    assert list(map(str, problems)) == [
        "/words has several types: a/msg/A, b/msg/B",
        "/words cannot be read: no module 'a'",
    ]


def test_program_that_exits_by_itself() -> None:
    problems, _ = compare(expecting(10.0), seen(20, 10.0, 1.9), 2.0, finished=True)
    assert problems == []
    problems, _ = compare(expecting(10.0), Observation(), 0.3, finished=True)
    assert list(map(str, problems)) == [
        (
            "exited on its own after 0.3 s, before a message on /words: "
            f"talker.py publishes {STRING} at 10 Hz"
        )
    ]
    script = Expectation(is_node=True, runs_nothing=True, source="talker.py")
    problems, _ = compare(script, Observation(), 0.3, finished=True)
    assert list(map(str, problems)) == ["exited on its own: nothing in talker.py spins its node"]
