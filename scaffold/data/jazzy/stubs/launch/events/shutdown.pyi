from launch.event import Event as Event

class Shutdown(Event):
    def __init__(
        self, *, reason: str = "reason not given", due_to_sigint: bool = False
    ) -> None: ...
    @property
    def reason(self) -> str: ...
    @property
    def due_to_sigint(self) -> bool: ...
