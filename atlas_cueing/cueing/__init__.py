"""Vehicle state to cue: what the platform should do, before anyone asks whether it can."""
