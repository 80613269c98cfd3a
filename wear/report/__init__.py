"""The report: a text in Markdown with computed values, written as a page and as LaTeX.

Contents
    paper.md, paper; scene.md, own              the texts of the reports, and their numbers
    text, document, number                     Markdown with values, labels numbered
    equations, markup                          equations with titles; plain text as Markdown
    writer, html, tex, templates               the writer and its two forms
    publish                                    the files of a report
    note, runs, claims                         its computations
    figures_of_note, drawing                   its figures
    explorer                                   the interactive page
"""
