from launch.events.process.process_exited import ProcessExited as ProcessExited
from launch.events.process.process_io import ProcessIO as ProcessIO
from launch.events.process.process_matchers import (
    matches_executable as matches_executable,
)
from launch.events.process.process_matchers import matches_name as matches_name
from launch.events.process.process_matchers import matches_pid as matches_pid
from launch.events.process.process_started import ProcessStarted as ProcessStarted
from launch.events.process.process_stderr import ProcessStderr as ProcessStderr
from launch.events.process.process_stdin import ProcessStdin as ProcessStdin
from launch.events.process.process_stdout import ProcessStdout as ProcessStdout
from launch.events.process.process_targeted_event import (
    ProcessTargetedEvent as ProcessTargetedEvent,
)
from launch.events.process.running_process_event import (
    RunningProcessEvent as RunningProcessEvent,
)
from launch.events.process.shutdown_process import ShutdownProcess as ShutdownProcess
from launch.events.process.signal_process import SignalProcess as SignalProcess
