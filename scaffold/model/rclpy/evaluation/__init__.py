"""Static evaluation of node code: attributes, constants and arrays."""
