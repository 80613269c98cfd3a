"""Identification: the parameters of a scene from measured wear, with their uncertainty.

Contents
    readings       measured wear of one or several specimens
    residuals      differences between a law and the readings
    model          the scenes of the specimens as a function of the free parameters
    least_squares  the parameters of least squares
    estimate       these, with their covariance and its principal directions
    profiles       profile likelihoods and the intervals that they give
    identifiability  combinations of parameters that the data do not determine, in words
    laws           simpler laws for comparison
    fit            a fit: all of these, with forecasts, lives and the next reading
    posterior      samples by an ensemble of walkers
    figures        readings with the fitted wear, profiles, corner of two parameters
"""
