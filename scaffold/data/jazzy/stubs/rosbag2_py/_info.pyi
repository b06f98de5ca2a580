from typing import Any

# Its methods were changed within each distribution.
Info: Any
