"""What stand-ins and checks both reckon with: a cable's words, how wheels drive, a camera sees.

Nothing here runs or measures anything.
"""
