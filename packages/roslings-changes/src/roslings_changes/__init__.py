"""Small changes that make a package wrong, and questions about them."""
