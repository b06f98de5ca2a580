"""Applies fixes in memory until no more apply."""
