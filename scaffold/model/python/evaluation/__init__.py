"""Static evaluation of Python expressions: values, attributes, arguments and returns."""
