"""Stubs of libraries and interfaces: their content, names and members."""
