"""The falsifier: a search for models that satisfy the hypotheses and violate the claim."""
