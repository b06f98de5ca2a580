from .log import LogInfo as LogInfo
