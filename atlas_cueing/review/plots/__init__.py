"""Plots of a review and of a comparison, one picture a file, with plotly (extra `report`).

Only the modules here and `report` know plotly.
"""
