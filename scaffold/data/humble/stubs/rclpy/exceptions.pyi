from typing import List, Union
from rclpy.parameter import AllowableParameterValue
from rclpy.parameter import Parameter
from typing import Any

class NotInitializedException(Exception):
    def __init__(self, *args: Any) -> None: ...

class NoTypeSupportImportedException(Exception):
    def __init__(self, *args: Any) -> None: ...

class NameValidationException(Exception):
    def __init__(
        self, name_type: str, name: str, error_msg: str, invalid_index: int, *args: Any
    ) -> None: ...

class InvalidHandle(RuntimeError): ...

class InvalidNamespaceException(NameValidationException):
    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None: ...

class InvalidNodeNameException(NameValidationException):
    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None: ...

class InvalidTopicNameException(NameValidationException):
    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None: ...

class InvalidServiceNameException(NameValidationException):
    def __init__(self, name: str, error_msg: str, invalid_index: int, *args: Any) -> None: ...

class ParameterException(Exception):
    def __init__(self, error_msg: str, parameters: Union[str, List[str]], *args: Any) -> None: ...

class ParameterNotDeclaredException(ParameterException):
    def __init__(self, parameters: Union[str, List[str]], *args: Any) -> None: ...

class ParameterAlreadyDeclaredException(ParameterException):
    def __init__(self, parameters: Union[str, List[str]], *args: Any) -> None: ...

class InvalidParameterException(ParameterException):
    def __init__(self, parameter: Any, *args: Any) -> None: ...

class InvalidParameterTypeException(ParameterException):
    def __init__(
        self, desired_parameter: Parameter, expected_type: Parameter.Type, *args: Any
    ) -> None: ...
    _actual_type: Any
    _param_name: Any

class InvalidParameterValueException(ParameterException):
    def __init__(
        self, parameter: str, value: AllowableParameterValue, reason: str, *args: Any
    ) -> None: ...

class ParameterImmutableException(ParameterException):
    def __init__(self, parameter: Any, *args: Any) -> None: ...

class ParameterUninitializedException(ParameterException):
    def __init__(self, parameter_name: str, *args: Any) -> None: ...

class ROSInterruptException(Exception):
    def __init__(self, *args: Any) -> None: ...
