from launch_ros.event_handlers.on_state_transition import (
    OnStateTransition as OnStateTransition,
)
