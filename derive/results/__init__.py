"""Results that the note does not have, a file an idea."""
