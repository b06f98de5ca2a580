"""Rewrites code for the type checker, so that it infers more."""
