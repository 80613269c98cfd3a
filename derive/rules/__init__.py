"""The rules: every theorem by which a judgement may follow from others.

Overview
    A rule reads its premises, proves its side conditions from them, and concludes.  What it
    needs and does not find it names.  The functions beside the rules apply them.
Contents
    assumption    hypotheses and definitions
    algebra       at an instant: substitute, solve, rewrite; hypotheses that are met
    inequalities  between reals, and from one quantity to another
    calculus      from rates to wear; the rigid support; scaled time
    limits        t -> oo
    drift         how limits are approached
    solutions     solutions of the differential equation, and their inverses
    averages      averaging over a sine load
    data          derivatives with respect to a parameter
    reading       the parts of claims, or a refusal
    proving       side conditions, decided by proof
"""
