"""The note in its own order, one file for each section."""
