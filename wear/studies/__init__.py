"""Studies: many scenes that differ in a few numbers, on one core or on a cluster.

Overview
    A study is a scene, the keys that vary, a design and the requested results. It is solved in
    chunks of rows; a chunk is a pure function of the study and its place, so that any worker may
    solve it, with the same digits.
Contents
    vary      one varied number of the scene: its levels, or its distribution
    design    grid, Sobol', Latin hypercube, random: the rows of every chunk
    rows      `Study`, the request; the rows of one chunk, solved together
    store     the results on disk, in whole chunks
    run       the chunks through any executor
    indices   Sobol' indices
    figures   pictures of the results
"""
