"""Iterates of the period map of du/dt = f(u, t) with periodic f, by Abel's functional equation."""
