"""Leaving nothing behind, however a run ends."""
