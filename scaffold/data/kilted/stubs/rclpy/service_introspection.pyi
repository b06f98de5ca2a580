from enum import Enum
from typing_extensions import TypeAlias as TypeAlias

class ServiceIntrospectionState(Enum):
    OFF = 0
    METADATA = 1
    CONTENTS = 2
