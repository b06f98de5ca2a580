"""The generator: templates, questions, answers and rendered files."""
