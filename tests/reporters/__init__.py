"""Tests of what `check` writes."""
