"""The command line: one module per verb, which parses, calls the engine and reports."""
