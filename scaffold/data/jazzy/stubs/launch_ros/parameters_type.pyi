from collections.abc import Mapping
from typing import Any, TypeAlias

from _ros_launch import Listed
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch_ros.parameter_descriptions import Parameter as ParameterDescription
from launch_ros.parameter_descriptions import ParameterFile as ParameterFile
from launch_ros.parameter_descriptions import (
    ParameterValue as ParameterValueDescription,
)

SomeParameterFile: TypeAlias = SomeSubstitutionsType | ParameterFile
SomeParameterValue: TypeAlias = (
    ParameterValueDescription | SomeSubstitutionsType | float | bool | bytes | Listed[Any]
)
SomeParametersDict: TypeAlias = Mapping[Any, Any]
SomeParameters: TypeAlias = Listed[SomeParameterFile | ParameterDescription | SomeParametersDict]

def __getattr__(name: str) -> Any: ...
