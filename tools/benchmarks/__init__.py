"""What `tools/benchmark` measures: one module for each section of its table, and what they share."""
