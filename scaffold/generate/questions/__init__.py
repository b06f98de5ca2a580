"""The questions of templates, and the answers to them."""
