"""The report on a terminal, which fits one screen."""
