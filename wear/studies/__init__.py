"""Studies: many scenes that differ in a few numbers, on one core or on a cluster.

Overview
    A study is a scene, what varies in it, a design and what is asked. It is solved in chunks of
    rows; a chunk is a pure function of the study and its place, so it may be solved anywhere and
    has the same digits everywhere.
Contents
    vary      a number of the scene that varies: levels, or a distribution
    design    grid, Sobol', Latin hypercube, random: the rows of every chunk
    rows      the rows of one chunk, solved together
    store     the results on disk: whole chunks or none
    run       the chunks through any executor
    indices   Sobol' indices
    figures   pictures of the answers
"""
