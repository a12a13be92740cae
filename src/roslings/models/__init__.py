"""What stand-ins and checks both reckon with: the words of a cable, and how wheels drive.

Nothing here runs or measures anything.
"""
