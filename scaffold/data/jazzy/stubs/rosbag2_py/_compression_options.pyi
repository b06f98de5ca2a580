from enum import Enum

class CompressionMode(Enum):
    NONE = ...
    FILE = ...
    MESSAGE = ...

class CompressionOptions:
    compression_format: str
    compression_mode: CompressionMode
    compression_queue_size: int
    compression_threads: int
    def __init__(
        self,
        compression_format: str = ...,
        compression_mode: CompressionMode = ...,
        compression_queue_size: int = ...,
        compression_threads: int = ...,
        compression_threads_priority: int = ...,
    ) -> None: ...

def compression_mode_from_string(mode: str, /) -> CompressionMode: ...
def compression_mode_to_string(mode: CompressionMode, /) -> str: ...
