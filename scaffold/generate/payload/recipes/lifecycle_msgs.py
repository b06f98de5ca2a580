"""Recipes for the messages of lifecycle_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "State": Recipe(
        summary="the state of a node that is activated and deactivated",
        code="""
            if self.count % 2 == 0:
                msg.id = State.PRIMARY_STATE_ACTIVE
                msg.label = 'active'
            else:
                msg.id = State.PRIMARY_STATE_INACTIVE
                msg.label = 'inactive'
        """,
        log="{msg.label}",
        checks=("message.label in ('active', 'inactive')",),
    ),
    "Transition": Recipe(
        summary="the transitions that activate and deactivate a node, in turn",
        code="""
            if self.count % 2 == 0:
                msg.id = Transition.TRANSITION_ACTIVATE
                msg.label = 'activate'
            else:
                msg.id = Transition.TRANSITION_DEACTIVATE
                msg.label = 'deactivate'
        """,
        log="{msg.label}",
        checks=("message.label in ('activate', 'deactivate')",),
    ),
    "TransitionDescription": Recipe(
        summary="transitions that activate and deactivate a node, in turn",
        code="""
            active = State(id=State.PRIMARY_STATE_ACTIVE, label='active')
            inactive = State(id=State.PRIMARY_STATE_INACTIVE, label='inactive')
            if self.count % 2 == 0:
                msg.transition.id = Transition.TRANSITION_ACTIVATE
                msg.transition.label = 'activate'
                msg.start_state = inactive
                msg.goal_state = active
            else:
                msg.transition.id = Transition.TRANSITION_DEACTIVATE
                msg.transition.label = 'deactivate'
                msg.start_state = active
                msg.goal_state = inactive
        """,
        log="{msg.start_state.label} to {msg.goal_state.label}",
        checks=("{message.start_state.label, message.goal_state.label} == {'active', 'inactive'}",),
    ),
    "TransitionEvent": Recipe(
        summary="the activation of a node",
        code="""
            msg.timestamp = self.get_clock().now().nanoseconds
            msg.transition.id = Transition.TRANSITION_ACTIVATE
            msg.transition.label = 'activate'
            msg.start_state = State(id=State.PRIMARY_STATE_INACTIVE, label='inactive')
            msg.goal_state = State(id=State.PRIMARY_STATE_ACTIVE, label='active')
        """,
        log="{msg.transition.label}",
        checks=("message.timestamp > 0", "message.goal_state.label == 'active'"),
    ),
}
