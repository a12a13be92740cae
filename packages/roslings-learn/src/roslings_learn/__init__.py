"""What a student reads and practises with: lessons, their notebooks, quizzes and drills."""
