from collections.abc import Callable, Iterable
from typing import Any, TypeVar
from launch_testing import actions as actions
from launch_testing import asserts as asserts
from launch_testing import event_handlers as event_handlers
from launch_testing import markers as markers
from launch_testing import tools as tools
from launch_testing import util as util
from launch_testing.io_handler import ActiveIoHandler as ActiveIoHandler
from launch_testing.io_handler import IoHandler as IoHandler
from launch_testing.proc_info_handler import ActiveProcInfoHandler as ActiveProcInfoHandler
from launch_testing.proc_info_handler import ProcInfoHandler as ProcInfoHandler
from .decorator import post_shutdown_test as post_shutdown_test
from .parametrize import parametrize as parametrize
from .ready_aggregator import ReadyAggregator as ReadyAggregator

_T = TypeVar("_T")

def post_shutdown_test() -> Callable[[_T], _T]: ...
def parametrize(argnames: str | Iterable[str], argvalues: Iterable[Any]) -> Callable[[_T], _T]: ...
def ready_to_test_action_timeout(timeout: float) -> Callable[[_T], _T]: ...

class ReadyAggregator:
    def __init__(self, ready_fn: Callable[[], Any], num_to_aggregate: int) -> None: ...
    def ready_fn(self) -> None: ...

def __getattr__(name: str) -> Any: ...
