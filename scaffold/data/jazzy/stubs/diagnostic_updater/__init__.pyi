from diagnostic_updater._diagnostic_status_wrapper import (
    DiagnosticStatusWrapper as DiagnosticStatusWrapper,
)
from diagnostic_updater._diagnostic_updater import (
    CompositeDiagnosticTask as CompositeDiagnosticTask,
)
from diagnostic_updater._diagnostic_updater import (
    DiagnosticTask as DiagnosticTask,
)
from diagnostic_updater._diagnostic_updater import (
    DiagnosticTaskVector as DiagnosticTaskVector,
)
from diagnostic_updater._diagnostic_updater import (
    FunctionDiagnosticTask as FunctionDiagnosticTask,
)
from diagnostic_updater._diagnostic_updater import (
    Updater as Updater,
)
from diagnostic_updater._publisher import (
    DiagnosedPublisher as DiagnosedPublisher,
)
from diagnostic_updater._publisher import (
    HeaderlessTopicDiagnostic as HeaderlessTopicDiagnostic,
)
from diagnostic_updater._publisher import (
    TopicDiagnostic as TopicDiagnostic,
)
from diagnostic_updater._update_functions import (
    FrequencyStatus as FrequencyStatus,
)
from diagnostic_updater._update_functions import (
    FrequencyStatusParam as FrequencyStatusParam,
)
from diagnostic_updater._update_functions import (
    Heartbeat as Heartbeat,
)
from diagnostic_updater._update_functions import (
    TimeStampStatus as TimeStampStatus,
)
from diagnostic_updater._update_functions import (
    TimeStampStatusParam as TimeStampStatusParam,
)
