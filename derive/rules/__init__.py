"""The rules: every theorem by which a judgement may follow from others.

Overview
    A rule reads its premises, proves its side conditions from them, and concludes, or names a
    missing premise.  It is applied to premises like a function; a rule without choices has one
    named instance: ``substitute = Substitute()``.
Contents
    assumption    hypotheses and definitions
    algebra       at an instant: substitute, solve, rewrite
    inequalities  between reals, and from one quantity to another
    calculus      from rates to wear; the rigid support; scaled time
    limits        t -> oo
    growth        wear without bound, and its consequences
    drift         the approach to limits
    solutions     solutions of the differential equation, and their inverses
    averages      averaging over a sine load
    data          derivatives with respect to a parameter
    reading       the parts of claims, or a refusal
    proving       side conditions, decided by proof
    theorem       rules whose conclusions are checked to have a value
"""
