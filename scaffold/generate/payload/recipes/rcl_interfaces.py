"""Recipes for the messages of rcl_interfaces."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_SPEED = "ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)"

RECIPES: dict[str, Recipe] = {
    "FloatingPointRange": Recipe(
        summary="a range of numbers whose end moves",
        code="""
            msg.from_value = 0.0
            msg.to_value = 2.0 + math.sin(self.count / 10.0)
            msg.step = 0.1
        """,
        log="{msg.from_value:.2f} to {msg.to_value:.2f}",
        checks=("message.from_value < message.to_value",),
    ),
    "IntegerRange": Recipe(
        summary="a range of whole numbers whose end moves",
        code="""
            msg.from_value = 0
            msg.to_value = 10 + self.count % 10
            msg.step = 1
        """,
        log="{msg.from_value} to {msg.to_value}",
        checks=("message.from_value < message.to_value",),
    ),
    "ListParametersResult": Recipe(
        summary="the names of parameters, one more each time up to ten",
        code="""
            msg.names = [f'motor.gain_{number}' for number in range(self.count % 10 + 1)]
            msg.prefixes = ['motor']
        """,
        log="{len(msg.names)} names",
        checks=("1 <= len(message.names) <= 10", "message.prefixes == ['motor']"),
    ),
    "Log": Recipe(
        summary="a line of a log",
        code="""
            msg.stamp = self.get_clock().now().to_msg()
            msg.level = Log.INFO
            msg.name = self.get_name()
            msg.msg = f'Hello World: {self.count}'
            msg.file = 'example.py'
            msg.function = 'publish_message'
            msg.line = 1
        """,
        log="{msg.msg}",
        checks=("message.level == Log.INFO", "message.msg.startswith('Hello World: ')"),
    ),
    "LoggerLevel": Recipe(
        summary="a logger that switches between the levels debug and info",
        code="""
            is_verbose = self.count % 2 == 0
            msg.name = self.get_name()
            msg.level = LoggerLevel.LOG_LEVEL_DEBUG if is_verbose else LoggerLevel.LOG_LEVEL_INFO
        """,
        log="{msg.name}: {msg.level}",
        checks=("message.name", "message.level in (10, 20)"),
    ),
    "Parameter": Recipe(
        summary="a parameter with a speed that changes",
        code="""
            msg.name = 'speed'
            msg.value.type = ParameterType.PARAMETER_DOUBLE
            msg.value.double_value = 0.5 + 0.1 * math.sin(self.count / 10.0)
        """,
        log="{msg.name}: {msg.value.double_value:.2f}",
        checks=("message.name == 'speed'", "0.4 <= message.value.double_value <= 0.6"),
    ),
    "ParameterDescriptor": Recipe(
        summary="the description of a parameter, and its range, whose end moves",
        code="""
            msg.name = 'speed'
            msg.type = ParameterType.PARAMETER_DOUBLE
            msg.description = 'How fast to drive, in meters per second'
            highest = 2.0 + math.sin(self.count / 10.0)
            msg.floating_point_range = [FloatingPointRange(from_value=0.0, to_value=highest)]
        """,
        log="{msg.floating_point_range[0].to_value:.2f}",
        checks=("message.name == 'speed'", "len(message.floating_point_range) == 1"),
    ),
    "ParameterEvent": Recipe(
        summary="a parameter that changes",
        code=f"""
            msg.stamp = self.get_clock().now().to_msg()
            msg.node = self.get_fully_qualified_name()
            value = 0.5 + 0.1 * math.sin(self.count / 10.0)
            speed = {_SPEED}
            msg.changed_parameters = [Parameter(name='speed', value=speed)]
        """,
        log="{msg.changed_parameters[0].name} of {msg.node}",
        checks=(
            "abs(time.time() - message.stamp.sec) < 60",
            "message.changed_parameters[0].name == 'speed'",
        ),
    ),
    "ParameterEventDescriptors": Recipe(
        summary="the description of a parameter that changed",
        code="""
            speed = ParameterDescriptor()
            speed.name = 'speed'
            speed.type = ParameterType.PARAMETER_DOUBLE
            speed.description = f'Changed {self.count} times'
            msg.changed_parameters = [speed]
        """,
        log="{msg.changed_parameters[0].description}",
        checks=("message.changed_parameters[0].name == 'speed'",),
    ),
    "ParameterType": Recipe(summary="nothing: the type has only constants", log="an empty message"),
    "ParameterValue": Recipe(
        summary="a number that moves up and down",
        code="""
            msg.type = ParameterType.PARAMETER_DOUBLE
            msg.double_value = 0.5 + 0.1 * math.sin(self.count / 10.0)
        """,
        log="{msg.double_value:.2f}",
        checks=("0.4 <= message.double_value <= 0.6",),
    ),
    "SetLoggerLevelsResult": Recipe(
        summary="success and failure in turn",
        code="""
            msg.successful = self.count % 2 == 0
            msg.reason = '' if msg.successful else 'the logger is not known'
        """,
        log="{msg.successful} {msg.reason}",
        checks=("message.successful == (not message.reason)",),
    ),
    "SetParametersResult": Recipe(
        summary="success and failure in turn",
        code="""
            msg.successful = self.count % 2 == 0
            msg.reason = '' if msg.successful else 'the value is out of range'
        """,
        log="{msg.successful} {msg.reason}",
        checks=("message.successful == (not message.reason)",),
    ),
}
