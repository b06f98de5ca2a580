"""Text formats, read with the exact place of every part."""
