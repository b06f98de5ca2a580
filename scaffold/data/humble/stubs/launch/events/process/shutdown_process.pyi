from launch.events.process.process_targeted_event import ProcessTargetedEvent
from ...actions import ExecuteProcess as ExecuteProcess

class ShutdownProcess(ProcessTargetedEvent): ...
