"""How the bags look in a report's page."""
