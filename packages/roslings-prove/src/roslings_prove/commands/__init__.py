"""What an author of labs types."""
