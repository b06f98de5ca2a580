"""Adds parts and extras to a package that exists."""
