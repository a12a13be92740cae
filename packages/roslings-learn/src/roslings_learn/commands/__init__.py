"""What a learner types to read and to practise."""
