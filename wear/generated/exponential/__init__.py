"""Generated code of the exponential contact law, one module a variant; not to be edited."""
