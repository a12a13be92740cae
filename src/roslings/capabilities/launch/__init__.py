"""Launch files: several nodes started by one command."""
