from enum import Enum

class SignalHandlerOptions(Enum):
    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3

def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None: ...
def get_current_signal_handlers_options() -> SignalHandlerOptions: ...
