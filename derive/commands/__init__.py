"""The commands of `derive`, a module each; SymPy is imported when one does its work."""
