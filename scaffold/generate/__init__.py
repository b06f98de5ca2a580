"""The generator: templates and their questions, answers, context, rendered files."""
