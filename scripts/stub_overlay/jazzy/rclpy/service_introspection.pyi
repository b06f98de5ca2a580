from enum import Enum

class ServiceIntrospectionState(Enum):
    OFF = 0
    METADATA = 1
    CONTENTS = 2
