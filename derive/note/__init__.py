"""The note, in its own order, a file a section."""
