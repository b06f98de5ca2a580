from launch.event_handlers.event_named import event_named as event_named
from launch.event_handlers.on_execution_complete import (
    OnExecutionComplete as OnExecutionComplete,
)
from launch.event_handlers.on_include_launch_description import (
    OnIncludeLaunchDescription as OnIncludeLaunchDescription,
)
from launch.event_handlers.on_process_exit import OnProcessExit as OnProcessExit
from launch.event_handlers.on_process_io import OnProcessIO as OnProcessIO
from launch.event_handlers.on_process_start import OnProcessStart as OnProcessStart
from launch.event_handlers.on_shutdown import OnShutdown as OnShutdown
