"""Results beyond the note, one file for each idea."""
