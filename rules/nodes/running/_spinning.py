"""Code of a file that only runs while its nodes are spun."""

from __future__ import annotations

from scaffold.api.rclpy import RclpyFile

_OF_RESPONSES = ("add_done_callback", "feedback_callback", ".result(", ".done(", "await ")


def needs_spin(file: RclpyFile) -> bool:
    """Return whether a file has anything that only runs if its node is spun.

    Requests and goals are sent without it; only their responses need it.
    """
    has_clients = bool(file.clients or file.action_clients)
    return bool(file.callbacks) or (has_clients and file.module.mentions(*_OF_RESPONSES))
