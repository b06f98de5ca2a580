from typing import Any

from diagnostic_updater._diagnostic_updater import (
    CompositeDiagnosticTask,
    DiagnosticTaskVector,
)
from diagnostic_updater._update_functions import (
    FrequencyStatus,
    FrequencyStatusParam,
    TimeStampStatus,
    TimeStampStatusParam,
)
from rclpy.publisher import Publisher

class HeaderlessTopicDiagnostic(CompositeDiagnosticTask):
    diag: DiagnosticTaskVector
    freq: FrequencyStatus
    def __init__(
        self, name: str, diag: DiagnosticTaskVector, freq: FrequencyStatusParam
    ) -> None: ...
    def tick(self) -> None: ...
    def clear_window(self) -> None: ...

class TopicDiagnostic(HeaderlessTopicDiagnostic):
    stamp: TimeStampStatus
    def __init__(
        self,
        name: str,
        diag: DiagnosticTaskVector,
        freq: FrequencyStatusParam,
        stamp: TimeStampStatusParam,
    ) -> None: ...
    def tick(self, stamp: Any) -> None: ...  # type: ignore[override]

class DiagnosedPublisher(TopicDiagnostic):
    publisher: Publisher
    def __init__(
        self,
        pub: Publisher[Any],
        diag: DiagnosticTaskVector,
        freq: FrequencyStatusParam,
        stamp: TimeStampStatusParam,
    ) -> None: ...
    def publish(self, message: Any) -> None: ...
