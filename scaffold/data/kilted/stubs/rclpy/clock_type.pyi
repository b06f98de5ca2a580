from typing_extensions import TypeAlias as TypeAlias

ClockType: TypeAlias = _rclpy.ClockType
