"""Cueing methods of somebody else, from files and installed packages, checked as ours are."""
