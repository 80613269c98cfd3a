"""Identification: the parameters of a scene from measured wear, and how certain they are.

Contents
    readings    measured wear of one or several specimens
    model       the scenes of the specimens as a function of the free parameters
    estimate    least squares, intervals, what the data do not determine, forecast
    laws        simpler laws that the same data are held against
"""
