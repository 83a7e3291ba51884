"""Rides of every flight by every method: flown, compared, and written into a page."""
