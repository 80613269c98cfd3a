"""Identification: the parameters of a scene from measured wear, and how certain they are.

Contents
    readings    measured wear of one or several specimens
"""
