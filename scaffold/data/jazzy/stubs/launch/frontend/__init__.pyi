from launch.frontend import type_utils as type_utils
from launch.frontend.entity import Entity as Entity
from launch.frontend.expose import (
    expose_action as expose_action,
)
from launch.frontend.expose import (
    expose_substitution as expose_substitution,
)
from launch.frontend.parser import (
    InvalidFrontendLaunchFileError as InvalidFrontendLaunchFileError,
)
from launch.frontend.parser import (
    Parser as Parser,
)
