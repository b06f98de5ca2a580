from launch.conditions.evaluate_condition_expression_impl import (
    evaluate_condition_expression as evaluate_condition_expression,
)
from launch.conditions.if_condition import IfCondition as IfCondition
from launch.conditions.invalid_condition_expression_error import (
    InvalidConditionExpressionError as InvalidConditionExpressionError,
)
from launch.conditions.launch_configuration_equals import (
    LaunchConfigurationEquals as LaunchConfigurationEquals,
)
from launch.conditions.launch_configuration_not_equals import (
    LaunchConfigurationNotEquals as LaunchConfigurationNotEquals,
)
from launch.conditions.unless_condition import UnlessCondition as UnlessCondition
