"""What a slow test needs is recorded when it runs, and the gate chooses by it.

    opened.py    which files of a clone are opened, by whatever process
    tree.py      a clone as its files are now, and what has become another
    records.py   what is kept of each test file: tests/proofs/needs
    recorder.py  runs test files one after the other, and makes their records
    choice.py    the rules: what runs, what is left out, and why
    plugin.py    `--needed FILE` of pytest: leaves out what was not chosen

`.ci/needs.py` is the command.
"""
