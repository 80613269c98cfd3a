"""The report: a text in Markdown with computed values, written as a page and as LaTeX.

Contents
    paper.md, paper                            the text of the paper, and its numbers
    scene.md, scene_report                     the report of a user's scene, and its numbers
    text, document, number                     Markdown with values, labels numbered
    equations, markup                          equations with titles; plain text as Markdown
    writer, html, tex, templates               the writer and its two forms
    publish                                    the files of a report
    note, runs, claims                         its computations
    figures_of_note, schematic                 its figures
    explorer                                   the interactive page
"""
