"""The middleware that RMW_IMPLEMENTATION selects is not installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine, middlewares

KNOWN = frozenset(
    {
        "rmw_connextdds",
        "rmw_cyclonedds_cpp",
        "rmw_fastrtps_cpp",
        "rmw_fastrtps_dynamic_cpp",
        "rmw_zenoh_cpp",
    }
)
"""The middlewares with packages."""


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding if RMW_IMPLEMENTATION names a missing middleware."""
    wanted = machine.variables.get("RMW_IMPLEMENTATION")
    if not wanted or not machine.prefixes:
        return
    available = middlewares(machine.prefixes)
    if wanted in available:
        return
    package = f"ros-{machine.distribution}-{wanted.replace('_', '-')}"
    yield Finding(
        Severity.ERROR,
        f"RMW_IMPLEMENTATION is {wanted!r}, which is not installed: `import rclpy` fails; "
        f"installed: {', '.join(available) or 'none'}",
        f"sudo apt install {package}  # or: unset RMW_IMPLEMENTATION"
        if wanted in KNOWN and any(map(machine.distribution_of, machine.prefixes))
        else "unset RMW_IMPLEMENTATION",
    )
