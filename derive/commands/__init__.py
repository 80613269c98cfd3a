"""The commands of `derive`, a module each; SymPy is imported at the execution of a command."""
