"""Isolates an executable under test from everything else."""
