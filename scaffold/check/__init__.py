"""The rule engine: diagnostics, rules, registry, runner, suppression, fixes."""
