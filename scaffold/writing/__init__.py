"""Writes files atomically: planned, locked, all or nothing."""
