# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from .managed_entity import ManagedEntity as ManagedEntity
from .managed_entity import SimpleManagedEntity as SimpleManagedEntity
from .node import LifecycleNode as LifecycleNode
from .node import LifecycleNodeMixin as LifecycleNodeMixin
from .node import LifecycleState as LifecycleState
from .publisher import LifecyclePublisher as LifecyclePublisher
from rclpy.lifecycle.managed_entity import TransitionCallbackReturn as TransitionCallbackReturn

Node = LifecycleNode
NodeMixin = LifecycleNodeMixin
State = LifecycleState
Publisher = LifecyclePublisher
