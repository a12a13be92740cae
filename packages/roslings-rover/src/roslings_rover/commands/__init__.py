"""What a learner types for the rover and its parts."""
