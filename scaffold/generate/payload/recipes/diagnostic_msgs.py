"""Recipes for the messages of diagnostic_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_STATUS = """
    temperature = 40.0 + 10.0 * math.sin(self.count / 10.0)  # degrees Celsius
    is_hot = temperature > 45.0
    {status}.level = DiagnosticStatus.WARN if is_hot else DiagnosticStatus.OK
    {status}.name = 'motor'
    {status}.message = 'hot' if is_hot else 'ok'
    {status}.hardware_id = 'motor_1'
    {status}.values = [KeyValue(key='temperature', value=f'{{temperature:.1f}}')]
"""

RECIPES: dict[str, Recipe] = {
    "DiagnosticArray": Recipe(
        summary="the state of a motor that gets hot now and then",
        code="    status = DiagnosticStatus()"
        + _STATUS.format(status="status")
        + "    msg.status = [status]",
        log="{msg.status[0].name}: {msg.status[0].message}",
        checks=(
            "[status.name for status in message.status] == ['motor']",
            "message.status[0].message in ('ok', 'hot')",
            (
                "(message.status[0].level == DiagnosticStatus.WARN) == (\n"
                "    message.status[0].message == 'hot')"
            ),
            "message.status[0].hardware_id == 'motor_1'",
            "30.0 <= float(message.status[0].values[0].value) <= 50.0",
        ),
        frame="",
    ),
    "DiagnosticStatus": Recipe(
        summary="the state of a motor that gets hot now and then",
        code=_STATUS.format(status="msg"),
        log="{msg.name}: {msg.message}",
        checks=(
            "message.level in (DiagnosticStatus.OK, DiagnosticStatus.WARN)",
            "len(message.values) == 1",
        ),
    ),
    "KeyValue": Recipe(
        summary="a temperature with its name",
        code="""
            temperature = 40.0 + 10.0 * math.sin(self.count / 10.0)  # degrees Celsius
            msg.key = 'temperature'
            msg.value = f'{temperature:.1f}'
        """,
        log="{msg.key}: {msg.value}",
        checks=("message.key == 'temperature'", "30.0 <= float(message.value) <= 50.0"),
    ),
}
