"""Messages in Python code: their types, fields and values."""
