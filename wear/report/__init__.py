"""The report: one document tree, written as a page and as LaTeX.

Contents
    document, words, walk, numbering, audit    what the report says
    display, formula, breaking, mathml         formulas
    html, html_prose, svg                      the page
    tex, tex_text, typeset                     LaTeX and its PDF
    publish                                    all files of a report
    drawing                                    the picture of the system
"""
