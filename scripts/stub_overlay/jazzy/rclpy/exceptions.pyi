from rclpy.parameter import AllowableParameterValue
from rclpy.parameter import Parameter

class InvalidHandle(RuntimeError): ...
