"""Keeps one executable under test apart from everything else."""
