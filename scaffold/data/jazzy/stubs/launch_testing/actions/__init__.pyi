from typing import Any

from launch.action import Action
from launch.actions.execute_process import ExecuteProcess
from launch.some_substitutions_type import SomeSubstitutionsType

class ReadyToTest(Action):
    def __init__(self) -> None: ...

class GTest(ExecuteProcess):
    def __init__(
        self,
        *,
        path: SomeSubstitutionsType,
        timeout: float | SomeSubstitutionsType | None = None,
        kill_timeout: float | SomeSubstitutionsType = 5.0,
        **kwargs: Any,
    ) -> None: ...

class PyTest(ExecuteProcess):
    def __init__(
        self,
        *,
        path: SomeSubstitutionsType,
        timeout: float | SomeSubstitutionsType | None = None,
        kill_timeout: float | SomeSubstitutionsType = 5.0,
        **kwargs: Any,
    ) -> None: ...

def __getattr__(name: str) -> Any: ...
