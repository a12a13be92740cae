"""Where the course lies, and what lies beside its graders: Python that a course brings.

It knows no other room: cards, evidence and pages are made with what is found here.
"""
