from launch.events import process as process
from launch.events.execution_complete import ExecutionComplete as ExecutionComplete
from launch.events.include_launch_description import (
    IncludeLaunchDescription as IncludeLaunchDescription,
)
from launch.events.matchers import matches_action as matches_action
from launch.events.shutdown import Shutdown as Shutdown
from launch.events.timer_event import TimerEvent as TimerEvent
