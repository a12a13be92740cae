"""Parameters: settings of a node, given at its start or while it runs."""
