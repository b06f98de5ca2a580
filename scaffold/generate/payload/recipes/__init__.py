"""Recipes by package: one module each, with ``RECIPES`` by the name of the message."""
