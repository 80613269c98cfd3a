"""Code generation: from derived problems to source text."""
