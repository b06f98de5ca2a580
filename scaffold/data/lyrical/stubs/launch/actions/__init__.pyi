from launch.actions.append_environment_variable import (
    AppendEnvironmentVariable as AppendEnvironmentVariable,
)
from launch.actions.declare_launch_argument import DeclareLaunchArgument as DeclareLaunchArgument
from launch.actions.emit_event import EmitEvent as EmitEvent
from launch.actions.execute_local import ExecuteLocal as ExecuteLocal
from launch.actions.execute_process import ExecuteProcess as ExecuteProcess
from launch.actions.group_action import GroupAction as GroupAction
from launch.actions.include_launch_description import (
    IncludeLaunchDescription as IncludeLaunchDescription,
)
from launch.actions.log_info import LogInfo as LogInfo
from launch.actions.opaque_coroutine import OpaqueCoroutine as OpaqueCoroutine
from launch.actions.opaque_function import OpaqueFunction as OpaqueFunction
from launch.actions.pop_environment import PopEnvironment as PopEnvironment
from launch.actions.pop_launch_configurations import (
    PopLaunchConfigurations as PopLaunchConfigurations,
)
from launch.actions.push_environment import PushEnvironment as PushEnvironment
from launch.actions.push_launch_configurations import (
    PushLaunchConfigurations as PushLaunchConfigurations,
)
from launch.actions.register_event_handler import RegisterEventHandler as RegisterEventHandler
from launch.actions.reset_environment import ResetEnvironment as ResetEnvironment
from launch.actions.reset_launch_configurations import (
    ResetLaunchConfigurations as ResetLaunchConfigurations,
)
from launch.actions.set_environment_variable import SetEnvironmentVariable as SetEnvironmentVariable
from launch.actions.set_launch_configuration import SetLaunchConfiguration as SetLaunchConfiguration
from launch.actions.shutdown_action import Shutdown as Shutdown
from launch.actions.timer_action import TimerAction as TimerAction
from launch.actions.unregister_event_handler import UnregisterEventHandler as UnregisterEventHandler
from launch.actions.unset_environment_variable import (
    UnsetEnvironmentVariable as UnsetEnvironmentVariable,
)
from launch.actions.unset_launch_configuration import (
    UnsetLaunchConfiguration as UnsetLaunchConfiguration,
)
from .declare_boolean_launch_argument import (
    DeclareBooleanLaunchArgument as DeclareBooleanLaunchArgument,
)
from .for_loop import ForEach as ForEach
from .for_loop import ForLoop as ForLoop
from .log import Log as Log
from .log import LogDebug as LogDebug
from .log import LogError as LogError
from .log import LogWarning as LogWarning
from .replace_environment_variables import (
    ReplaceEnvironmentVariables as ReplaceEnvironmentVariables,
)
