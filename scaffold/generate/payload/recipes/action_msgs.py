"""Recipes for the messages of action_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "GoalInfo": Recipe(
        summary="a new goal: a random identifier and the time",
        code="""
            msg.goal_id.uuid = list(uuid.uuid4().bytes)
            msg.stamp = self.get_clock().now().to_msg()
        """,
        log="{uuid.UUID(bytes=bytes(msg.goal_id.uuid))}",
        checks=("any(message.goal_id.uuid)", "abs(time.time() - message.stamp.sec) < 60"),
    ),
    "GoalStatus": Recipe(
        summary="a goal that is executing",
        code="""
            msg.goal_info.goal_id.uuid = list(uuid.uuid4().bytes)
            msg.goal_info.stamp = self.get_clock().now().to_msg()
            msg.status = GoalStatus.STATUS_EXECUTING
        """,
        log="status {msg.status}",
        checks=(
            "message.status == GoalStatus.STATUS_EXECUTING",
            "abs(time.time() - message.goal_info.stamp.sec) < 60",
        ),
    ),
    "GoalStatusArray": Recipe(
        summary="one goal that succeeded and one that is executing",
        code="""
            for status in (GoalStatus.STATUS_SUCCEEDED, GoalStatus.STATUS_EXECUTING):
                goal = GoalStatus(status=status)
                goal.goal_info.goal_id.uuid = list(uuid.uuid4().bytes)
                goal.goal_info.stamp = self.get_clock().now().to_msg()
                msg.status_list.append(goal)
        """,
        log="{len(msg.status_list)} goals",
        checks=(
            "len(message.status_list) == 2",
            "all(abs(time.time() - goal.goal_info.stamp.sec) < 60 for goal in message.status_list)",
        ),
    ),
}
