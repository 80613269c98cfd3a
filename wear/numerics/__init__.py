"""Numerical methods that know no model: quadrature, collocation, Chebyshev series."""
