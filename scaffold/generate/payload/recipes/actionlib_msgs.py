"""Recipes for the messages of actionlib_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "GoalID": Recipe(
        summary="the number of a goal and the time",
        code="""
            msg.stamp = self.get_clock().now().to_msg()
            msg.id = f'goal_{self.count}'
        """,
        log="{msg.id}",
        checks=("abs(time.time() - message.stamp.sec) < 60", "message.id.startswith('goal_')"),
    ),
    "GoalStatus": Recipe(
        summary="a goal that is executing",
        code="""
            msg.goal_id.stamp = self.get_clock().now().to_msg()
            msg.goal_id.id = f'goal_{self.count}'
            msg.status = GoalStatus.ACTIVE
            msg.text = 'on the way'
        """,
        log="{msg.goal_id.id}: {msg.text}",
        checks=("message.status == GoalStatus.ACTIVE", "message.goal_id.id.startswith('goal_')"),
    ),
    "GoalStatusArray": Recipe(
        summary="one goal that succeeded and one that is executing",
        code="""
            for status in (GoalStatus.SUCCEEDED, GoalStatus.ACTIVE):
                goal = GoalStatus(status=status)
                goal.goal_id.stamp = msg.header.stamp
                goal.goal_id.id = f'goal_{self.count + len(msg.status_list)}'
                msg.status_list.append(goal)
        """,
        log="{len(msg.status_list)} goals",
        checks=(
            "len(message.status_list) == 2",
            "all(goal.goal_id.id.startswith('goal_') for goal in message.status_list)",
        ),
        frame="",
    ),
}
