"""Edits that add a part to an existing package and keep the formatting.

Each module edits one kind of file: a function takes its text and returns the new text and, where an
edit is not safe, the lines to add by hand. Additions that exist already are not repeated, so a
second run changes nothing.
"""
