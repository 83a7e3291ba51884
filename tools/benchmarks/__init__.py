"""What `tools/benchmark` measures: a module for each section of its table, and what they share."""
