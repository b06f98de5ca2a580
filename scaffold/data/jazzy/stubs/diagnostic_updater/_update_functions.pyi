from collections.abc import Mapping
from typing import Any

from diagnostic_updater._diagnostic_updater import DiagnosticTask

class FrequencyStatusParam:
    freq_bound: Mapping[str, float]
    tolerance: float
    window_size: int
    def __init__(
        self, freq_bound: Mapping[str, float], tolerance: float = 0.1, window_size: int = 5
    ) -> None: ...

class FrequencyStatus(DiagnosticTask):
    params: FrequencyStatusParam
    def __init__(self, params: FrequencyStatusParam, name: str = "FrequencyStatus") -> None: ...
    def clear(self) -> None: ...
    def tick(self) -> None: ...

class TimeStampStatusParam:
    max_acceptable: float
    min_acceptable: float
    def __init__(self, min_acceptable: float = -1, max_acceptable: float = 5) -> None: ...

class TimeStampStatus(DiagnosticTask):
    params: TimeStampStatusParam
    def __init__(
        self, params: TimeStampStatusParam = ..., name: str = "Timestamp Status"
    ) -> None: ...
    def tick(self, stamp: Any) -> None: ...

class Heartbeat(DiagnosticTask):
    def __init__(self) -> None: ...
