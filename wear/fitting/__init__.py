"""Identification: the parameters of a scene from measured wear, and how certain they are.

Contents
    readings       measured wear of one or several specimens
    residuals      how far a law is from the readings
    model          the scenes of the specimens as a function of the free parameters
    least_squares  the nearest parameters
    estimate       these, with their covariance and the directions in which the data see them
    profiles       profile likelihoods and the intervals that they give
    openness       what the data leave open, in words
    laws           simpler laws that the same data are held against
    fit            a fit: all of these, with forecasts, lives and the next reading
    posterior      samples by an ensemble of walkers
    figures        readings with the fitted wear, profiles, corner of two parameters
"""
