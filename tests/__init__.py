"""The tests, and the helpers that they share."""

PATIENCE = 300.0
"""Seconds to wait for what has to happen: that a machine is slow is no defect of the project."""
