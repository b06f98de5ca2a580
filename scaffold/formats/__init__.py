"""Parsers for text formats, with exact source locations."""
