"""Views of a motion: one body, joint or force."""
