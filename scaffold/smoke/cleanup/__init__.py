"""Cleanup after a run, however it ends."""
