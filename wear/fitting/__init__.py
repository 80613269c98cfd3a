"""Identification: the parameters of a scene from measured wear, and how certain they are.

Contents
    readings       measured wear of one or several specimens
    residuals      how far a law is from the readings
    model          the scenes of the specimens as a function of the free parameters
    least_squares  the nearest parameters
    estimate       a fit: estimates, covariance
    profiles       profile likelihoods and the intervals that they give
    forecast       what is left open, forecasts, lives, the next reading
    laws           simpler laws that the same data are held against
    posterior      samples by an ensemble of walkers
"""
