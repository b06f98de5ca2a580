from typing import Any

from launch.condition import Condition as Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution
from launch_ros.parameters_type import SomeParameters as SomeParameters
from launch_ros.remap_rule_type import SomeRemapRules as SomeRemapRules

class ComposableNode:
    def __init__(
        self,
        *,
        package: SomeSubstitutionsType,
        plugin: SomeSubstitutionsType,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        parameters: SomeParameters | None = None,
        remappings: SomeRemapRules | None = None,
        extra_arguments: SomeParameters | None = None,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def package(self) -> list[Substitution]: ...
    @property
    def node_plugin(self) -> list[Substitution]: ...
    @property
    def node_name(self) -> list[Substitution] | None: ...
    @property
    def node_namespace(self) -> list[Substitution] | None: ...
    @property
    def parameters(self) -> Any: ...
    @property
    def remappings(self) -> Any: ...
    @property
    def extra_arguments(self) -> Any: ...
    def condition(self) -> Condition | None: ...
