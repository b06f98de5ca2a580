"""Edits that add a part to an existing package: existing text keeps its form.

Each module edits one kind of file: a function on its text gives the new text and, where an edit
is not safe, the lines to write by hand. What is there already is left alone, so that a second run
changes nothing.
"""
