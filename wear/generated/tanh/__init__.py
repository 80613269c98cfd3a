"""Generated code of the tanh contact law, one module a variant; not to be edited."""
