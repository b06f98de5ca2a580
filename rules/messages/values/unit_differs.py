"""MS034: values have the units of the fields that they are assigned to."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, MessageRule, Report, Severity
from scaffold.api.messages import MessageTypes

from ._angles import DEGREES, OF_EULER

_NODE = (
    "import math\n\nfrom sensor_msgs.msg import FluidPressure, Imu, JointState, Range\n\n\n"
    "def read(board):\n"
    "    pressure_hpa = board.pressure()\n"
    "    air = FluidPressure(fluid_pressure={})\n"
    "    imu = Imu()\n"
    "    imu.angular_velocity.z = {}\n"
    "    joints = JointState(name=['pan', 'tilt'])\n"
    "    joints.position = {}\n"
    "    return air, imu, joints, Range(range={})\n"
)
_RIGHT = (
    "pressure_hpa * 100.0",
    "math.radians(board.gyro_dps)",
    "[math.radians(angle) for angle in board.angles_deg]",
    "board.read_mm() / 1000.0",
)
_HINTS: Mapping[str, Mapping[str, str]] = {
    "radians": {"degrees": "use math.radians()"},
    "degrees": {"radians": "use math.degrees()"},
    "radians per second": {
        "degrees per second": "use math.radians()",
        "degrees": "use math.radians()",
        "revolutions per minute": "multiply by 2 * math.pi / 60",
    },
    "meters": {
        "millimeters": "divide by 1000",
        "centimeters": "divide by 100",
        "kilometers": "multiply by 1000",
    },
    "meters per second": {
        "kilometers per hour": "divide by 3.6",
        "millimeters per second": "divide by 1000",
        "centimeters per second": "divide by 100",
        "knots": "multiply by 0.514444",
    },
    "m/s²": {"g": "multiply by 9.80665", "milli-g": "multiply by 0.00980665"},
    "pascals": {
        "hectopascals": "multiply by 100",
        "kilopascals": "multiply by 1000",
        "bar": "multiply by 100000",
    },
    "degrees Celsius": {
        "kelvins": "subtract 273.15",
        "degrees Fahrenheit": "subtract 32 and divide by 1.8",
    },
    "fractions from 0 to 1": {"percent": "divide by 100"},
    "volts": {"millivolts": "divide by 1000"},
    "teslas": {"microteslas": "multiply by 1e-6", "gauss": "multiply by 1e-4"},
}
"""Hints for values in other units, by the unit of a field."""
_SUFFIXES: Mapping[str, str] = {
    **dict.fromkeys(("deg", "degs", "degree", "degrees"), "degrees"),
    **dict.fromkeys(("rad", "rads", "radian", "radians"), "radians"),
    **dict.fromkeys(("dps", "degps"), "degrees per second"),
    "rpm": "revolutions per minute",
    **dict.fromkeys(("mm", "millimeters", "millimetres"), "millimeters"),
    **dict.fromkeys(("cm", "centimeters", "centimetres"), "centimeters"),
    **dict.fromkeys(("km", "kilometers", "kilometres"), "kilometers"),
    **dict.fromkeys(("kmh", "kph"), "kilometers per hour"),
    **dict.fromkeys(("knot", "knots"), "knots"),
    **dict.fromkeys(("hpa", "mbar", "millibar"), "hectopascals"),
    "kpa": "kilopascals",
    "bar": "bar",
    **dict.fromkeys(("kelvin", "kelvins"), "kelvins"),
    "fahrenheit": "degrees Fahrenheit",
    **dict.fromkeys(("percent", "pct"), "percent"),
    **dict.fromkeys(("mv", "millivolts"), "millivolts"),
    "ut": "microteslas",
    "gauss": "gauss",
    "g": "g",
    "mg": "milli-g",
}
"""Units by the last word of a name."""
_FIELDS: Mapping[tuple[str, str], str] = {
    ("sensor_msgs/msg/JointState", "position"): "radians",
    ("sensor_msgs/msg/JointState", "velocity"): "radians per second",
    ("trajectory_msgs/msg/JointTrajectoryPoint", "positions"): "radians",
    ("trajectory_msgs/msg/JointTrajectoryPoint", "velocities"): "radians per second",
    **{
        ("sensor_msgs/msg/LaserScan", f"angle_{name}"): "radians"
        for name in ("min", "max", "increment")
    },
    **{
        ("sensor_msgs/msg/LaserScan", name): "meters"
        for name in ("range_min", "range_max", "ranges")
    },
    **{("sensor_msgs/msg/Range", name): "meters" for name in ("min_range", "max_range", "range")},
    ("sensor_msgs/msg/Range", "field_of_view"): "radians",
    ("sensor_msgs/msg/NavSatFix", "latitude"): "degrees",
    ("sensor_msgs/msg/NavSatFix", "longitude"): "degrees",
    ("sensor_msgs/msg/NavSatFix", "altitude"): "meters",
    ("sensor_msgs/msg/FluidPressure", "fluid_pressure"): "pascals",
    ("sensor_msgs/msg/RelativeHumidity", "relative_humidity"): "fractions from 0 to 1",
    ("sensor_msgs/msg/Temperature", "temperature"): "degrees Celsius",
    ("sensor_msgs/msg/BatteryState", "temperature"): "degrees Celsius",
    ("sensor_msgs/msg/BatteryState", "percentage"): "fractions from 0 to 1",
    ("sensor_msgs/msg/BatteryState", "voltage"): "volts",
}
"""From the comments of the definitions."""
_VECTORS: Mapping[tuple[str, str], str] = {
    ("sensor_msgs/msg/Imu", "angular_velocity"): "radians per second",
    ("sensor_msgs/msg/Imu", "linear_acceleration"): "m/s²",
    ("sensor_msgs/msg/MagneticField", "magnetic_field"): "teslas",
    ("geometry_msgs/msg/Twist", "linear"): "meters per second",
    ("geometry_msgs/msg/Twist", "angular"): "radians per second",
    ("geometry_msgs/msg/Accel", "linear"): "m/s²",
    ("geometry_msgs/msg/Pose", "position"): "meters",
    ("geometry_msgs/msg/Transform", "translation"): "meters",
}
"""The vectors whose x, y and z are assigned."""
_CONVERSIONS: Mapping[str, str] = {
    **dict.fromkeys(("degrees", "rad2deg"), "degrees"),
    **dict.fromkeys(("radians", "deg2rad"), "radians"),
}
_OF_RADIANS = frozenset(
    f"{module}.{name}" for module in ("math", "numpy") for name in ("sin", "cos", "tan")
)
_COLDEST, _HOTTEST, _FRACTION = 200.0, 400.0, 0.15
"""The range of usual temperatures in kelvins, and the fraction of 0 °C in it."""
_SAME = frozenset({"float", "abs", "round", "list", "array", "asarray", "float32", "float64"})
_OF_ITSELF = frozenset({"tolist", "copy", "astype", "item", "flatten"})
_AXES = frozenset({"x", "y", "z"})
_MAX_DEPTH = 6
_PER = re.compile(r"_(?:per|p)_?(?:s|sec|second)$|_s$")


class UnitDiffers(MessageRule):
    """A message field or a trigonometric function gets a value in the wrong unit.

    **Why.** The number is sent unchanged, without an error: the robot turns 57 times as far, or
    stops a kilometer before the wall.

    **Fix.** Convert the value before it is assigned, for example with ``math.radians()``. Lengths
    are in meters, angles in radians, times in seconds.

    **Source.** REP 103, "Standard Units of Measure"; the comments of the definitions in
    common_interfaces.
    """

    code = "MS034"
    name = "unit-differs"
    other_severities = {Severity.WARNING: "the unit is inferred from the name of the value"}
    examples = (
        Example(
            "degrees passed to a function that expects radians",
            {
                "turn.py": "import math\n\nfrom geometry_msgs.msg import Pose\n"
                "from rclpy.node import Node\n\n\n"
                "def rotation(yaw):\n    return math.sin(yaw / 2.0), math.cos(yaw / 2.0)\n\n\n"
                "def converted(yaw):\n    yaw = math.radians(yaw)\n    return math.sin(yaw)\n\n\n"
                "class Turn(Node):\n"
                "    def turn(self, yaw):\n"
                "        rotation(yaw)\n        converted(math.degrees(yaw))\n"
                "        return Pose(), rotation(math.degrees(yaw))\n",
            },
            "20:33: 'yaw' of rotation() is in radians, but this is in degrees; use math.radians()",
        ),
        Example("values converted to SI units", {"board.py": _NODE.format(*_RIGHT)}),
        Example(
            "hectopascals, degrees and millimeters in message fields",
            {
                "board.py": _NODE.format(
                    "pressure_hpa",
                    "board.gyro_dps",
                    "[math.degrees(angle) for angle in board.angles]",
                    "board.read_mm()",
                )
            },
            Report(
                "8:40",
                "fluid_pressure is in pascals, but this is in hectopascals; multiply by 100",
                severity=Severity.WARNING,
            ),
            Report(
                "10:30",
                "angular_velocity.z is in radians per second, but this is in degrees "
                "per second; use math.radians()",
                severity=Severity.WARNING,
            ),
            "12:24: position is in radians, but this is in degrees; use math.radians()",
            Report(
                "13:42",
                "range is in meters, but this is in millimeters; divide by 1000",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "names that only look like a unit",
            {
                "board.py": _NODE.format(
                    "board.bar_graph", "board.speed_deg_to_rad(3)", "board.pan_ticks", "board.cm()"
                ).replace("board.pressure()", "board.pressure() * 100.0")
            },
        ),
        Example(
            "degrees passed to math.cos(), km/h unpacked from a tuple",
            {
                "turn.py": "import math\n\nfrom geometry_msgs.msg import Twist\n\n\n"
                "def turned(heading_deg, speed_kmh):\n"
                "    forward, sideways = speed_kmh\n"
                "    twist = Twist()\n"
                "    twist.linear.x = forward * math.cos(heading_deg)\n"
                "    twist.linear.y = sideways\n"
                "    twist.linear.y = sideways * math.sin(math.radians(heading_deg))\n"
                "    return twist\n"
            },
            Report(
                "9:41",
                "the argument of math.cos() is in radians, but this is in degrees; use "
                "math.radians()",
                severity=Severity.WARNING,
            ),
            Report(
                "10:22",
                "linear.y is in meters per second, but this is in kilometers per hour; "
                "divide by 3.6",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "variable reassigned to the converted value",
            {
                "board.py": "import math\n\nfrom sensor_msgs.msg import LaserScan\n\n\n"
                "def scan(start_deg, end_deg):\n"
                "    start_deg = math.radians(start_deg)\n"
                "    return LaserScan(angle_min=start_deg, angle_max=math.radians(end_deg))\n"
            },
        ),
        Example(
            "attribute set to degrees in a callback, passed to math.cos()",
            {
                "wind.py": "import math\n\nfrom geometry_msgs.msg import Vector3\n"
                "from rclpy.node import Node\n\n\n"
                "class Wind(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('wind')\n"
                "        self.course = 0.0\n\n"
                "    def on_course(self, msg):\n"
                "        self.course = math.degrees(msg.data)\n\n"
                "    def wind(self):\n"
                "        return Vector3(x=math.cos(self.course))\n"
            },
            "16:35: the argument of math.cos() is in radians, but this is in degrees; use "
            "math.radians()",
        ),
        Example(
            "whole degrees, kelvins",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/turn.py": "import math\n\nfrom geometry_msgs.msg import Quaternion\n\n\n"
                "def to_quaternion(yaw):\n"
                "    return Quaternion(z=math.sin(yaw / 2), w=math.cos(yaw / 2))\n",
                "rover/base.py": "from sensor_msgs.msg import JointState, Temperature\n"
                "from tf_transformations import quaternion_from_euler\n\n"
                "from rover.turn import to_quaternion\n\n\n"
                "def turns(outside):\n"
                "    warm = Temperature(temperature=outside.celsius + 273.15)\n"
                "    cold = Temperature(temperature=outside.celsius + 3.15)\n"
                "    back = to_quaternion(180.0), quaternion_from_euler(0, 0, 90)\n"
                "    ahead = to_quaternion(1.5), quaternion_from_euler(0, 0, 3)\n"
                "    return warm, cold, back, ahead, JointState(position=[45.0, 0.5])\n",
            },
            Report(
                "rover/base.py:8:36",
                "temperature is in degrees Celsius, but this is in kelvins; subtract 273.15",
                severity=Severity.WARNING,
            ),
            Report(
                "rover/base.py:10:26",
                "'yaw' of to_quaternion() is in radians, but this is in degrees; use "
                "math.radians()",
                severity=Severity.WARNING,
            ),
            Report(
                "rover/base.py:10:62",
                "the argument of tf_transformations.quaternion_from_euler() is in "
                "radians, but this is in degrees; use math.radians()",
                severity=Severity.WARNING,
            ),
            Report(
                "rover/base.py:12:58",
                "position is in radians, but this is in degrees; use math.radians()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "values whose names say their unit",
            {
                "board.py": "import math\n\nfrom geometry_msgs.msg import Twist\n"
                "from sensor_msgs.msg import (\n    BatteryState, FluidPressure, Imu, "
                "MagneticField, NavSatFix, Range,\n    RelativeHumidity, Temperature,\n)\n\n\n"
                "def read(board):\n"
                "    imu, field, twist = Imu(), MagneticField(), Twist()\n"
                "    imu.angular_velocity.z = board.wheel_rpm\n"
                "    imu.linear_acceleration.x = board.x_g\n"
                "    imu.linear_acceleration.y = board.y_mg\n"
                "    field.magnetic_field.x = board.x_ut\n"
                "    field.magnetic_field.y = board.y_gauss\n"
                "    twist.linear.x = board.speed_mm_per_s\n"
                "    twist.linear.y = board.speed_cm_per_s\n"
                "    twist.linear.z = board.speed_knots\n"
                "    return (\n        imu, field, twist,\n"
                "        NavSatFix(latitude=math.radians(board.latitude)),\n"
                "        Range(range=board.distance_cm, max_range=board.limit_km),\n"
                "        FluidPressure(fluid_pressure=board.water_kpa),\n"
                "        FluidPressure(fluid_pressure=board.water_bar),\n"
                "        Temperature(temperature=board.air_fahrenheit),\n"
                "        BatteryState(percentage=board.charge_percent, voltage=board.cell_mv),\n"
                "        RelativeHumidity(relative_humidity=board.humidity_pct),\n    )\n",
            },
            Report(
                "12:30",
                "angular_velocity.z is in radians per second, but this is in "
                "revolutions per minute; multiply by 2 * math.pi / 60",
                severity=Severity.WARNING,
            ),
            Report(
                "13:33",
                "linear_acceleration.x is in m/s², but this is in g; multiply by 9.80665",
                severity=Severity.WARNING,
            ),
            Report(
                "14:33",
                "linear_acceleration.y is in m/s², but this is in milli-g; multiply by 0.00980665",
                severity=Severity.WARNING,
            ),
            Report(
                "15:30",
                "magnetic_field.x is in teslas, but this is in microteslas; multiply by 1e-6",
                severity=Severity.WARNING,
            ),
            Report(
                "16:30",
                "magnetic_field.y is in teslas, but this is in gauss; multiply by 1e-4",
                severity=Severity.WARNING,
            ),
            Report(
                "17:22",
                "linear.x is in meters per second, but this is in millimeters per "
                "second; divide by 1000",
                severity=Severity.WARNING,
            ),
            Report(
                "18:22",
                "linear.y is in meters per second, but this is in centimeters per "
                "second; divide by 100",
                severity=Severity.WARNING,
            ),
            Report(
                "19:22",
                "linear.z is in meters per second, but this is in knots; multiply by 0.514444",
                severity=Severity.WARNING,
            ),
            "22:28: latitude is in degrees, but this is in radians; use math.degrees()",
            Report(
                "23:21",
                "range is in meters, but this is in centimeters; divide by 100",
                severity=Severity.WARNING,
            ),
            Report(
                "23:50",
                "max_range is in meters, but this is in kilometers; multiply by 1000",
                severity=Severity.WARNING,
            ),
            Report(
                "24:38",
                "fluid_pressure is in pascals, but this is in kilopascals; multiply by 1000",
                severity=Severity.WARNING,
            ),
            Report(
                "25:38",
                "fluid_pressure is in pascals, but this is in bar; multiply by 100000",
                severity=Severity.WARNING,
            ),
            Report(
                "26:33",
                "temperature is in degrees Celsius, but this is in degrees Fahrenheit; "
                "subtract 32 and divide by 1.8",
                severity=Severity.WARNING,
            ),
            Report(
                "27:33",
                "percentage is in fractions from 0 to 1, but this is in percent; divide by 100",
                severity=Severity.WARNING,
            ),
            Report(
                "27:63",
                "voltage is in volts, but this is in millivolts; divide by 1000",
                severity=Severity.WARNING,
            ),
            Report(
                "28:44",
                "relative_humidity is in fractions from 0 to 1, but this is in "
                "percent; divide by 100",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "names of parameters, and a parameter that is converted elsewhere",
            {
                "where.py": "import math\n\nfrom geometry_msgs.msg import Point, Quaternion\n"
                "from rclpy.node import Node\n\n\n"
                "class Where(Node):\n"
                "    def ahead(self):\n"
                "        yaw = math.sin(self.get_parameter('yaw_deg').value / 2)\n"
                "        roll = math.sin(self.get_parameter('roll').value / 2)\n"
                "        return Quaternion(z=yaw), Quaternion(x=roll)\n\n\n"
                "def to_meters(lat, lon, lat0, lon0):\n"
                "    north = math.radians(lat - lat0) * 6371e3\n"
                "    east = math.radians(lon - lon0) * 6371e3\n"
                "    point = Point(x=east * math.cos(lat0), y=north)\n"
                "    return point, Point(x=east * math.cos(math.radians(lat0)), y=north)\n",
            },
            Report(
                "9:24",
                "the argument of math.sin() is in radians, but this is in degrees; use "
                "math.radians()",
                severity=Severity.WARNING,
            ),
            Report(
                "17:37",
                "the argument of math.cos() is in radians, but this is in degrees; use "
                "math.radians()",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for item in (*types.assigned, *types.passed):
            key = (item.owner.name, item.field.name)
            wanted = _FIELDS.get(key, "")
            if not wanted and item.field.name in _AXES:
                wanted = _VECTORS.get(_vector(types, item.holder), "")
            if wanted:
                shown = item.field.name
                if item.field.name in _AXES:
                    shown = f"{_vector(types, item.holder)[1]}.{shown}"
                yield from self._check(types, item.value, wanted, shown)
        for angle, name in _angles(types):
            yield from self._check(types, angle, "radians", f"the argument of {name}()")
        known: dict[MessageTypes, Mapping[ast.AST, str]] = {}
        for own in types.own_calls:
            if own.types not in known:
                known[own.types] = _parameters(own.types)
            for parameter in own.function.args.args:
                value = own.given(parameter) if parameter in known[own.types] else None
                if value is not None and own.is_in(types, value):
                    yield from self._check(types, value, "radians", known[own.types][parameter])

    def _check(
        self, types: MessageTypes, value: ast.expr, wanted: str, shown: str
    ) -> Iterator[Diagnostic]:
        for node in _elements(value):
            unit, is_by_name = _unit(types, node)
            if not unit:
                unit, is_by_name = _unit_of_number(types, node, wanted), True
            if not unit and wanted == "radians" and _is_converted_elsewhere(types, node):
                unit = "degrees"
            hint = _HINTS[wanted].get(unit, "")
            if hint:
                message = f"{shown} is in {wanted}, but this is in {unit}; {hint}"
                severity = Severity.WARNING if is_by_name else None
                yield self.report(types.module.location(node), message, severity=severity)


def _is_converted_elsewhere(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether a parameter is part of what the same function converts to radians."""
    function = types.module.enclosing_function(node)
    if not isinstance(node, ast.Name) or function is None:
        return False
    bindings = types.module.index.bindings_of(node)
    if len(bindings) != 1 or bindings[0].kind != "parameter":
        return False
    converted = [
        call.args[0]
        for name in ("math.radians", "numpy.radians", "numpy.deg2rad")
        for call in types.module.calls_of(name)
        if call.args and types.module.enclosing_function(call) is function
    ]
    parts = [
        part
        for value in converted
        for part in ((value.left, value.right) if isinstance(value, ast.BinOp) else (value,))
        if not isinstance(value, ast.BinOp) or isinstance(value.op, ast.Add | ast.Sub)
    ]
    return any(isinstance(part, ast.Name) and part.id == node.id for part in parts)


def _unit_of_number(types: MessageTypes, node: ast.expr, wanted: str) -> str:
    """Return the unit that a number is typical of: 90 in degrees, 293.15 in kelvins."""
    if wanted == "radians" and abs(_number(types, node)) in DEGREES:
        return "degrees"
    numbers = [_number(types, node)]
    match node:
        case ast.BinOp(op=ast.Add(), left=left, right=right):
            numbers = [_number(types, left), _number(types, right)]
    is_celsius = wanted == "degrees Celsius"
    return "kelvins" if is_celsius and any(map(_is_in_kelvins, numbers)) else ""


def _number(types: MessageTypes, node: ast.expr) -> float:
    """Return a number; 0 if it is not known."""
    value = types.file.evaluator.number(node)
    return value if isinstance(value, int | float) else 0


def _is_in_kelvins(number: float) -> bool:
    return _COLDEST < number < _HOTTEST and round(number % 1, 2) == _FRACTION


def _without_factor(angle: ast.expr) -> ast.expr:
    """Return the angle of which a half is taken, as for a quaternion; else the angle itself."""
    match angle:
        case ast.BinOp(left=whole, op=ast.Div() | ast.Mult(), right=ast.Constant(value=2 | 0.5)):
            return whole
        case ast.BinOp(left=ast.Constant(value=0.5), op=ast.Mult(), right=whole):
            return whole
    return angle


def _angles(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield the angles in radians that functions take, each with the name of the function."""
    for name in _OF_RADIANS:
        for call in types.module.calls_of(name):
            if len(call.args) == 1:
                yield _without_factor(call.args[0]), name
    for name in OF_EULER:
        for call in types.module.calls_of(name):
            yield from ((angle, name) for angle in call.args[:3])


def _parameters(types: MessageTypes) -> Mapping[ast.AST, str]:
    """Return the parameters of functions of a file that are angles in radians, by parameter."""
    result: dict[ast.AST, str] = {}
    for angle, _ in _angles(types):
        function = types.module.enclosing_function(angle)
        if not isinstance(angle, ast.Name) or not isinstance(function, ast.FunctionDef):
            continue
        bindings = types.module.index.bindings_of(angle)
        if len(bindings) == 1 and bindings[0].node in function.args.args:
            result[bindings[0].node] = f"{angle.id!r} of {function.name}()"
    return result


def _elements(value: ast.expr) -> Iterator[ast.expr]:
    """Yield the assigned values: those of a list one by one."""
    match value:
        case ast.List(elts=elements) | ast.Tuple(elts=elements):
            yield from elements
        case ast.ListComp(elt=element):
            yield element
        case _:
            yield value


def _vector(types: MessageTypes, holder: ast.expr) -> tuple[str, str]:
    """Return the message and the field of a vector whose x, y or z is assigned."""
    above = types.module.parent(holder)
    match holder, above:
        case ast.Attribute(value=outer, attr=field), _:
            owner = types.type_of(outer)
        case ast.Call(), ast.keyword(arg=str() as field):
            made = types.module.parent(above)
            owner = types.class_of(made.func) if isinstance(made, ast.Call) else None
        case ast.Call(), ast.Assign(targets=[ast.Attribute(value=outer, attr=field)]):
            owner = types.type_of(outer)
        case _:
            return "", ""
    return (owner.name, field) if owner else ("", "")


def _unit(types: MessageTypes, node: ast.expr, depth: int = 0) -> tuple[str, bool]:
    """Return the unit of a value, and whether only its name implies it; empty if unknown."""
    for _ in range(_MAX_DEPTH):
        inner = _origin(node)
        if inner is None:
            break
        node = inner
    match node:
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=[_]):
            return _CONVERSIONS.get(name, ""), False
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=[]):
            return _unit_named(name), True
        case ast.Attribute(
            attr="value",
            value=ast.Call(
                func=ast.Attribute(attr="get_parameter" | "declare_parameter"),
                args=[ast.Constant(value=str(name)), *_],
            ),
        ):
            return _unit_named(name), True
        case ast.Subscript(slice=ast.Constant(value=str() as name)):
            return _unit_named(name), True
        case ast.Name() | ast.Attribute() if depth < _MAX_DEPTH:
            return _unit_of_name(types, node, depth)
    return "", False


def _origin(node: ast.expr) -> ast.expr | None:
    """Return the origin of the value of an expression in the same unit."""
    match node:
        case ast.UnaryOp(operand=inner) | ast.Starred(value=inner):
            return inner
        case ast.Call(func=ast.Name(id=name) | ast.Attribute(attr=name), args=[inner, *_]) if (
            name in _SAME
        ):
            return inner
        case ast.Call(func=ast.Attribute(attr=name, value=inner)) if name in _OF_ITSELF:
            return inner
        case ast.Subscript(value=inner, slice=index):
            is_key = isinstance(index, ast.Constant) and isinstance(index.value, str)
            return None if is_key else inner
    return None


def _unit_of_name(
    types: MessageTypes, node: ast.Name | ast.Attribute, depth: int
) -> tuple[str, bool]:
    """Return the unit of a name: that of its only value, or the one in the name."""
    values = [value for value in _values(types, node) if not _is_zero(value)]
    units = {_unit(types, value, depth + 1) for value in values}
    stated = {unit for unit, is_by_name in units if unit and not is_by_name}
    if stated:
        return (stated.pop(), False) if len(units) == 1 else ("", False)
    name = node.id if isinstance(node, ast.Name) else node.attr
    named = _unit_named(name)
    is_computed = any(isinstance(value, ast.BinOp) for value in values)
    if named:
        return ("" if is_computed and len(values) > 1 else named), True
    return units.pop() if len(units) == 1 else ("", False)


def _is_zero(value: ast.expr) -> bool:
    """Return whether a value is the same in all units, as the initial value of an attribute."""
    return isinstance(value, ast.Constant) and not value.value


def _values(types: MessageTypes, node: ast.Name | ast.Attribute) -> list[ast.expr]:
    """Return the values assigned to a name or an attribute of the object."""
    if isinstance(node, ast.Attribute):
        return [*(types.file.evaluator.attribute_values(node) or ())]
    values: list[ast.expr] = []
    for binding in types.module.index.bindings_of(node):
        unpacked = types.module.parent(types.module.parent(binding.node) or binding.node)
        if binding.value is not None:
            values.append(binding.value)
        elif isinstance(unpacked, ast.Assign) and isinstance(unpacked.targets[0], ast.Tuple):
            values.append(unpacked.value)
    return values


def _unit_named(name: str) -> str:
    """Return the unit in a name: its last word."""
    lower = re.sub(r"([a-z])([A-Z])", r"\1_\2", name).lower()
    is_rate = _PER.search(lower) is not None
    words = [word for word in re.split(r"[_\d]+", _PER.sub("", lower)) if word]
    if len(words) <= 1 or not {"from", "per", "to", "in"}.isdisjoint(words):
        return ""
    unit = _SUFFIXES.get(words[-1], "")
    return f"{unit} per second" if is_rate and unit else unit
