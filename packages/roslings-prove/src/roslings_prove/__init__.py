"""For those who write labs: make a new one, prove it, release the students' edition."""
