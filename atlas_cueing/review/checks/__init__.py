"""Checks of a log, one kind of fault a file; each gives the findings of its kind.

A check derives again, with numpy and `own_rotations`, what the log says, and takes nothing from the
packages that made the log. So an error there does not hide itself here.
"""
