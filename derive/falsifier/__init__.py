"""The second route: models that satisfy hypotheses, and perhaps not the claim."""
