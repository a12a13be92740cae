"""The shapes in which a verdict is written for other programs."""

SHAPES = {
    "junit": "a continuous integration server",
    "gradescope": "Gradescope (results.json)",
    "check50": "tools that read check50's JSON",
    "classroom": "GitHub Classroom's reporter (JSON)",
    "prairielearn": "PrairieLearn (results.json)",
    "vpl": "Moodle's Virtual Programming Lab",
}
"""The option's name to who reads it."""
