"""Keeps a package in step with its templates."""
