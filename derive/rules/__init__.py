"""The rules: every theorem by which a judgement may follow from others.

Overview
    A rule reads its premises, proves its side conditions from them, and concludes.  What it
    needs and does not find it names.  A rule is applied to premises like a function; one that
    leaves its author nothing to choose has a name for it: ``substitute = Substitute()``.
Contents
    assumption    hypotheses and definitions
    algebra       at an instant: substitute, solve, rewrite; hypotheses that are met
    inequalities  between reals, and from one quantity to another
    calculus      from rates to wear; the rigid support; scaled time
    limits        t -> oo
    growth        wear without bound, and what follows
    drift         how limits are approached
    solutions     solutions of the differential equation, and their inverses
    averages      averaging over a sine load
    data          derivatives with respect to a parameter
    reading       the parts of claims, or a refusal
    proving       side conditions, decided by proof
"""
