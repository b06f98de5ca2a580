"""Checks on the workers of a cluster."""
