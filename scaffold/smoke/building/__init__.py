"""Builds packages and runs their tests with colcon."""
