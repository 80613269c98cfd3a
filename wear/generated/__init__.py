"""Generated code, one module a variant; not to be edited."""
