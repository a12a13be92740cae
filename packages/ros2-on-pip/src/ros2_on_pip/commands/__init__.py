"""One module a command: its verbs, their options, and what each prints."""
