"""Cleanup: leaves nothing behind, however a run ends."""
