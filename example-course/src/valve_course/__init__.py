"""A course of its own: what its labs need beside roslings."""
