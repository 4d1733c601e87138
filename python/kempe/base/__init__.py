"""What all parts use: read-only arrays, files, names in errors, units of display."""
