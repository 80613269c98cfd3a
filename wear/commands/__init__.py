"""The commands, a module each, with `add_arguments` and `execute`; `wear.cli` lists them.

Modules are light at import: a command imports its tools when it runs.
"""
