"""What a learner types for the desk."""
