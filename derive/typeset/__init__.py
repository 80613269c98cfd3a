"""Typesetting: relations as LaTeX that an author would have written."""
