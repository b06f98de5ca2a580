"""Recipes by package: one module each, with ``RECIPES`` by message name."""
