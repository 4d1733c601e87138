"""The analyses, one file for each type, with their options and records."""
