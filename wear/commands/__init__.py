"""The commands, a module each. A module defines `COMMAND`; `wear.cli` has the table of them.

Modules are light at import: what a command needs to do its work is imported when it does it.
"""
